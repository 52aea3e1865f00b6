#include "passo/cam/kicad_board.hpp"

#include <algorithm>
#include <charconv>
#include <map>

#include "copper_builder.hpp"
#include "kicad_shapes.hpp"
#include <fmt/format.h>

#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

constexpr std::string_view begin_of_board = "(kicad_pcb";
constexpr const char* edge_name = "Edge.Cuts";

// Indices of copper layers, from the top down.
using Sheets = std::vector<std::size_t>;

class KicadBoardReader {
 public:
  KicadBoardReader(const std::string& name, std::string_view text, Diagnostics& diagnostics)
      : diagnostics_(diagnostics),
        text_(name, text, diagnostics),
        builder_(name, "kicad", "KiCad", edge_name, diagnostics) {}

  DesignBoard read();

 private:
  void read_layers(KicadItem item);
  void read_item(KicadItem item);
  void read_footprint(KicadItem item);
  void read_graphic(KicadItem item, const KicadFrame& frame);
  void read_track(KicadItem item);
  void read_via(KicadItem item);
  void read_pad(KicadItem item, const KicadFrame& around);
  void read_zone(KicadItem item);
  void read_fill(KicadItem item, std::size_t sheet, Nanometres width);

  std::string canonical(std::string_view name) const;
  Sheets sheets_of(KicadItem item) const;  // of (layer ...) or (layers ...)
  void add_graphic(std::size_t sheet, const KicadGraphic& graphic, std::uint32_t line, bool is_track);
  void add_place(std::size_t sheet, DrawnPoint at, KicadItem item);
  void add_hole(KicadItem item, const KicadDrill& drill, const KicadFrame& frame, bool is_plated);
  bool is_done() const { return builder_.is_full() || text_.full(); }

  Diagnostics& diagnostics_;
  KicadText text_;
  CopperBuilder builder_;
  std::vector<std::string> sheets_;              // names of the copper layers
  std::map<std::size_t, std::size_t> unfilled_;  // zones of each layer
  std::map<std::string, std::string> names_;     // of copper layers as the user calls them (KiCad 4 and 5)
};

// "F.Cu", "B.Cu", or "In1.Cu" to "In30.Cu".
bool is_copper_name(std::string_view name) {
  return name.ends_with(".Cu") && (name == "F.Cu" || name == "B.Cu" || name.starts_with("In"));
}

int number_of_inner(std::string_view name) {
  int number = 0;
  std::from_chars(name.data() + 2, name.data() + name.size(), number);
  return number;
}

// From the top down.
int rank_of(std::string_view name) {
  constexpr int below_all = 1000;
  return name == "F.Cu" ? 0 : name == "B.Cu" ? below_all : number_of_inner(name);
}

// (layers (0 "F.Cu" signal) (31 "B.Cu" signal) ...). A user of KiCad 4 or 5 could call copper as he liked; its number
// tells what it is.
void KicadBoardReader::read_layers(KicadItem item) {
  if (!sheets_.empty()) return;
  for (KicadItem list = item.first(); list; list = list.next()) {
    if (!list.node().is_list || sheets_.size() >= 64) continue;
    const std::string_view name = list.text(0);
    const std::string_view kind = list.text(1);
    int number = -1;
    std::from_chars(list.name().data(), list.name().data() + list.name().size(), number);
    std::string known(name);
    const bool is_copper = kind == "signal" || kind == "power" || kind == "mixed" || kind == "jumper";
    if (!is_copper_name(name)) {
      constexpr int last_copper = 31;
      if (!is_copper || number < 0 || number > last_copper) continue;
      known = number == 0 ? "F.Cu" : number == last_copper ? "B.Cu" : fmt::format("In{}.Cu", number);
      names_[std::string(name)] = known;
    }
    if (std::ranges::find(sheets_, known) == sheets_.end()) sheets_.push_back(known);
  }
  std::ranges::stable_sort(sheets_, {}, [](const std::string& one) { return rank_of(one); });
  for (const std::string& one : sheets_) builder_.add_sheet(one);
}

std::string KicadBoardReader::canonical(std::string_view name) const {
  const auto found = names_.find(std::string(name));
  return found == names_.end() ? std::string(name) : found->second;
}

Sheets KicadBoardReader::sheets_of(KicadItem item) const {
  KicadItem list = item.find("layers");
  if (!list) list = item.find("layer");
  Sheets found;
  if (!list) return found;
  for (std::size_t sheet = 0; sheet < sheets_.size(); ++sheet) {
    const std::string& one = sheets_[sheet];
    for (KicadItem word = list.first(); word; word = word.next()) {
      const std::string_view name = word.name();
      const bool is_outside = one == "F.Cu" || one == "B.Cu";
      const bool fits = name == "*.Cu" || (name == "F&B.Cu" && is_outside) || (name == "*In.Cu" && !is_outside) ||
                        canonical(name) == one;
      if (!fits) continue;
      found.push_back(sheet);
      break;
    }
  }
  return found;
}

// A line that is a part of a pad is no track.
void KicadBoardReader::add_graphic(std::size_t sheet, const KicadGraphic& graphic, std::uint32_t line, bool is_track) {
  const DrawnPath& path = graphic.path;
  if (graphic.is_filled) {
    builder_.add_face(sheet, "", chords_of_path(path.points, true, gerber_tolerance), line, path.width);
  } else if (is_track) {
    builder_.add_stroke(sheet, "", path, line);
  } else {
    builder_.add_line(sheet, "", path, line);
  }
}

void KicadBoardReader::read_graphic(KicadItem item, const KicadFrame& frame) {
  const KicadItem layer = item.find("layer");
  if (!layer) return;
  if (layer.text(0) == edge_name) {
    if (const auto graphic = kicad_graphic(text_, item, frame, false)) builder_.add_edge(graphic->path);
    return;
  }
  for (const std::size_t sheet : sheets_of(item)) {
    if (const auto graphic = kicad_graphic(text_, item, frame, true))
      add_graphic(sheet, *graphic, text_.line_of(item), true);
  }
}

void KicadBoardReader::read_track(KicadItem item) {
  for (const std::size_t sheet : sheets_of(item)) {
    if (const auto graphic = kicad_graphic(text_, item, {}, false))
      add_graphic(sheet, *graphic, text_.line_of(item), true);
  }
}

void KicadBoardReader::add_place(std::size_t sheet, DrawnPoint at, KicadItem item) {
  const KicadItem net = item.find("net");
  const std::string_view words = net ? net.text(net.word(1) ? 1 : 0) : std::string_view();
  builder_.add_place(sheet, std::string(words), at, text_.line_of(item));
}

void KicadBoardReader::add_hole(KicadItem item, const KicadDrill& drill, const KicadFrame& frame, bool is_plated) {
  if (drill.across.count == 0) return;
  const std::uint32_t layer = is_plated ? 0 : 1;
  if (drill.across == drill.up) {
    builder_.add_hole({frame.at, drill.across, layer, text_.line_of(item)});
    return;
  }
  const bool lies = drill.across > drill.up;
  const Nanometres width = std::min(drill.across, drill.up);
  const Nanometres reach{(std::max(drill.across, drill.up).count - width.count) / 2};
  const DrawnPoint end{lies ? reach : Nanometres{}, lies ? Nanometres{} : reach};
  DrawnPath slot;
  const DrawnPoint begin{{-end.x.count}, {-end.y.count}};
  slot.points = {{frame.placed(begin), 0}, {frame.placed(end), 0}};
  slot.width = width;
  slot.layer = layer;
  slot.line = text_.line_of(item);
  builder_.add_slot(std::move(slot));
}

// A via goes through all copper from the one of its layers to the other.
void KicadBoardReader::read_via(KicadItem item) {
  const KicadFrame frame{kicad_frame(text_, item, {}).at, 0};
  const Sheets ends = sheets_of(item);
  add_hole(item, kicad_drill(text_, item), frame, true);
  if (item.has("blind") || item.has("buried")) builder_.note_once("blind and buried vias are drilled through");
  if (ends.empty()) return;
  for (std::size_t sheet = ends.front(); sheet <= ends.back(); ++sheet) {
    const KicadItem own = kicad_layer_of_padstack(item, sheets_[sheet]);
    KicadItem size = own ? own.find("size") : KicadItem();
    if (!size) size = item.find("size");
    if (!size) return text_.refuse(item, "kicad.bad-pad", "the via has no size", "(size DIAMETER)");
    const Nanometres diameter = text_.length(size, 0);
    if (diameter.count <= 0) continue;
    builder_.add_area(sheet, "", moved(disc_ring({}, static_cast<double>(diameter.count)), frame.at),
                      text_.line_of(item));
    add_place(sheet, frame.at, item);
  }
}

void KicadBoardReader::read_pad(KicadItem item, const KicadFrame& around) {
  const KicadFrame hole = kicad_frame(text_, item, around);
  const KicadDrill drill = kicad_drill(text_, item);
  const bool is_bare = item.text(1) == "np_thru_hole";
  add_hole(item, drill, hole, !is_bare);
  if (item.has("remove_unused_layers") || item.has("remove_unused_layer")) {
    builder_.note_once("pads keep their copper on all layers, even where they are not connected");
  }
  for (const std::size_t sheet : sheets_of(item)) {
    const KicadPad pad = kicad_pad(text_, item, sheets_[sheet]);
    if (pad.rings.empty()) continue;
    // A hole with no more copper than the hole itself.
    if (is_bare && pad.is_round && pad.across == drill.across && pad.up == drill.up) continue;
    const KicadFrame shape{hole.placed(drill.offset), hole.degrees};
    for (const DrawnRing& ring : pad.rings) builder_.add_area(sheet, "", shape.placed(ring), text_.line_of(item));
    for (KicadGraphic graphic : pad.primitives) {
      for (PathPoint& point : graphic.path.points) point.at = shape.placed(point.at);
      add_graphic(sheet, graphic, text_.line_of(item), false);
    }
    add_place(sheet, hole.at, item);
  }
}

void KicadBoardReader::read_footprint(KicadItem item) {
  const KicadFrame frame = kicad_frame(text_, item, {});
  for (KicadItem part = item.first(); part && !is_done(); part = part.next()) {
    if (part.is("pad")) {
      read_pad(part, frame);
    } else if (part.is("zone")) {
      read_zone(part);
    } else if (part.is("fp_text") || part.is("fp_text_box") || part.is("property")) {
      const KicadItem hide = part.find("hide");
      const bool is_hidden = hide ? hide.text(0) != "no" : part.has("hide");
      if (is_hidden) continue;
      for (const std::size_t sheet : sheets_of(part)) builder_.add_text(sheet);
    } else if (part.node().is_list && part.name().starts_with("fp_")) {
      read_graphic(part, frame);
    }
  }
}

// The ways of a fill that KiCad 4 and 5 made of lines, two points each, or one face.
void KicadBoardReader::read_fill(KicadItem item, std::size_t sheet, Nanometres width) {
  for (KicadItem pts = item.first(); pts; pts = pts.next()) {
    if (!pts.is("pts")) continue;
    DrawnPath path;
    path.points = kicad_points(text_, pts);
    path.width = width;
    if (path.points.size() < 2) continue;
    if (item.is("fill_segments")) {
      builder_.add_line(sheet, "", path, text_.line_of(item));
    } else {
      builder_.add_face(sheet, "", chords_of_path(path.points, true, gerber_tolerance), text_.line_of(item), width);
    }
  }
}

void KicadBoardReader::read_zone(KicadItem item) {
  if (item.has("keepout")) return;
  const KicadItem thickness = item.find("min_thickness");
  const KicadItem is_drawn = item.find("filled_areas_thickness");
  const bool has_line = thickness && !(is_drawn && is_drawn.text(0) == "no");
  const Nanometres width = has_line ? std::max(text_.length(thickness, 0), {}) : Nanometres{};
  bool has_fill = false;
  for (KicadItem part = item.first(); part && !is_done(); part = part.next()) {
    if (!part.is("filled_polygon") && !part.is("fill_segments")) continue;
    has_fill = true;
    for (const std::size_t sheet : sheets_of(part.find("layer") ? part : item)) read_fill(part, sheet, width);
  }
  if (has_fill) return;
  for (const std::size_t sheet : sheets_of(item)) ++unfilled_[sheet];
}

void KicadBoardReader::read_item(KicadItem item) {
  const std::string_view name = item.name();
  if (name == "layers") {
    read_layers(item);
  } else if (name == "segment" || name == "arc") {
    read_track(item);
  } else if (name == "via") {
    read_via(item);
  } else if (name == "footprint" || name == "module") {
    read_footprint(item);
  } else if (name == "zone") {
    read_zone(item);
  } else if (name == "gr_text" || name == "gr_text_box" || name == "dimension" || name == "table") {
    for (const std::size_t sheet : sheets_of(item)) builder_.add_text(sheet);
  } else if (name.starts_with("gr_")) {
    read_graphic(item, {});
  }
}

DesignBoard KicadBoardReader::read() {
  if (!text_.begins_with("kicad_pcb")) return {};
  while (!is_done()) {
    const KicadItem item = text_.next();
    if (!item) break;
    read_item(item);
  }
  if (sheets_.empty() && !diagnostics_.any_error()) {
    builder_.refuse("no-board", 0, "the board has no copper layer", "(layers (0 \"F.Cu\" signal) ...)");
  }
  for (const auto& [sheet, count] : unfilled_) {
    builder_.add_note(
        sheet, count == 1
                   ? "a zone is not filled: fill it in KiCad (key B) and save the board"
                   : fmt::format("{} zones are not filled: fill them in KiCad (key B) and save the board", count));
  }
  return builder_.take();
}

}  // namespace

bool looks_like_kicad_board(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text.substr(first).starts_with(begin_of_board);
}

DesignBoard read_kicad_board(const std::string& name, std::string_view text, Diagnostics& diagnostics) {
  return KicadBoardReader(name, text, diagnostics).read();
}

}  // namespace passo
