#include "passo/cam/kicad_board.hpp"

#include <algorithm>
#include <charconv>
#include <map>

#include "gerber_image.hpp"
#include "kicad_shapes.hpp"
#include <fmt/format.h>

#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

constexpr std::string_view begin_of_board = "(kicad_pcb";
constexpr std::string_view edge_name = "Edge.Cuts";

// A layer of copper while it is read.
struct Sheet {
  std::string name;
  GerberImage image;
  std::vector<std::string> nets = {""};
  std::size_t texts = 0;
  std::size_t unfilled = 0;  // zones
};

class KicadBoardReader {
 public:
  KicadBoardReader(const std::string& name, std::string_view text, Diagnostics& diagnostics)
      : name_(name), diagnostics_(diagnostics), text_(name, text, diagnostics) {
    edge_.strokes.file = name;
    edge_.strokes.layers = {std::string(edge_name)};
    edge_.apertures.emplace_back();
    drills_.file = name;
    drills_.layers = {"plated", "not plated"};
  }

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
  void read_fill(KicadItem item, Sheet& sheet, Nanometres width);

  std::string canonical(std::string_view name) const;
  std::vector<Sheet*> sheets_of(KicadItem item);  // of (layer ...) or (layers ...)
  Sheet* sheet(std::string_view name);
  bool has_room_for(KicadItem item, std::size_t points);
  void add(KicadItem item, Sheet& sheet, DrawnRing ring);
  void add_stroke(KicadItem item, Sheet& sheet, const DrawnPath& path);
  void add_face(KicadItem item, Sheet& sheet, const DrawnRing& ring, Nanometres width);
  void add_graphic(KicadItem item, Sheet& sheet, const KicadGraphic& graphic);
  void add_flash(Sheet& sheet, DrawnPoint at, KicadItem item);
  void add_hole(KicadItem item, const KicadDrill& drill, const KicadFrame& frame, bool is_plated);
  void note_once(const char* words);
  GerberLayer layer_of(Sheet& sheet);

  const std::string& name_;
  Diagnostics& diagnostics_;
  KicadText text_;
  RegionBudget budget_;
  std::vector<Sheet> sheets_;                 // of copper, from the top down
  std::map<std::string, std::string> names_;  // of copper layers as the user calls them (KiCad 4 and 5)
  GerberLayer edge_;
  Drawing drills_;
  std::vector<std::string> notes_;
  std::size_t points_ = 0;
  bool is_full_ = false;
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
    if (sheet(known) == nullptr) sheets_.push_back({known, {}});
  }
  std::ranges::stable_sort(sheets_, {}, [](const Sheet& one) { return rank_of(one.name); });
}

std::string KicadBoardReader::canonical(std::string_view name) const {
  const auto found = names_.find(std::string(name));
  return found == names_.end() ? std::string(name) : found->second;
}

Sheet* KicadBoardReader::sheet(std::string_view name) {
  const auto found = std::ranges::find_if(sheets_, [&](const Sheet& one) { return one.name == name; });
  return found == sheets_.end() ? nullptr : &*found;
}

std::vector<Sheet*> KicadBoardReader::sheets_of(KicadItem item) {
  KicadItem list = item.find("layers");
  if (!list) list = item.find("layer");
  std::vector<Sheet*> found;
  if (!list) return found;
  for (Sheet& one : sheets_) {
    for (KicadItem word = list.first(); word; word = word.next()) {
      const std::string_view name = word.name();
      const bool is_outside = one.name == "F.Cu" || one.name == "B.Cu";
      const bool fits = name == "*.Cu" || (name == "F&B.Cu" && is_outside) || (name == "*In.Cu" && !is_outside) ||
                        canonical(name) == one.name;
      if (!fits) continue;
      found.push_back(&one);
      break;
    }
  }
  return found;
}

void KicadBoardReader::note_once(const char* words) {
  if (std::ranges::find(notes_, words) == notes_.end()) notes_.emplace_back(words);
}

bool KicadBoardReader::has_room_for(KicadItem item, std::size_t points) {
  points_ += points + 4;
  if (points_ <= most_gerber_points) return true;
  if (!is_full_) text_.refuse(item, "kicad.too-large", "the board has too many points", "at most 16 million");
  is_full_ = true;
  return false;
}

void KicadBoardReader::add(KicadItem item, Sheet& sheet, DrawnRing ring) {
  if (ring.size() < 3 || !has_room_for(item, ring.size())) return;
  sheet.image.add(Region{{std::move(ring)}}, true);
}

void KicadBoardReader::add_stroke(KicadItem item, Sheet& sheet, const DrawnPath& path) {
  if (!has_room_for(item, kicad_stroke_points(path))) return;
  for (DrawnRing& ring : kicad_stroke(path)) {
    if (ring.size() >= 3) sheet.image.add(Region{{std::move(ring)}}, true);
  }
}

// A face whose ring may cross itself, and whose rim is drawn with a line.
void KicadBoardReader::add_face(KicadItem item, Sheet& sheet, const DrawnRing& ring, Nanometres width) {
  if (ring.size() < 3 || !has_room_for(item, ring.size())) return;
  if (!budget_.affords(std::vector<const DrawnRing*>{&ring})) {
    text_.refuse(item, "kicad.too-large", "the lines of this filled shape cross too often",
                 "a shape that can be filled");
    is_full_ = true;
    return;
  }
  Region face = filled({ring});
  if (width.count > 0) face = grown(face, {width.count / 2}, gerber_tolerance);
  for (const DrawnRing& one : face.rings) points_ += one.size();
  sheet.image.add(std::move(face), true);
}

void KicadBoardReader::add_graphic(KicadItem item, Sheet& sheet, const KicadGraphic& graphic) {
  const DrawnPath& path = graphic.path;
  if (graphic.is_filled) {
    add_face(item, sheet, chords_of_path(path.points, true, gerber_tolerance), path.width);
  } else if (path.width.count > 0) {
    add_stroke(item, sheet, path);
    sheet.image.strokes.push_back(path);
  }
}

void KicadBoardReader::read_graphic(KicadItem item, const KicadFrame& frame) {
  const KicadItem layer = item.find("layer");
  if (!layer) return;
  if (layer.text(0) == edge_name) {
    if (const auto graphic = kicad_graphic(text_, item, frame, false)) {
      edge_.strokes.paths.push_back(graphic->path);
      has_room_for(item, kicad_stroke_points(graphic->path));
    }
    return;
  }
  for (Sheet* const one : sheets_of(item)) {
    if (const auto graphic = kicad_graphic(text_, item, frame, true)) add_graphic(item, *one, *graphic);
  }
}

void KicadBoardReader::read_track(KicadItem item) {
  for (Sheet* const one : sheets_of(item)) {
    if (const auto graphic = kicad_graphic(text_, item, {}, false)) add_graphic(item, *one, *graphic);
  }
}

void KicadBoardReader::add_flash(Sheet& sheet, DrawnPoint at, KicadItem item) {
  const KicadItem net = item.find("net");
  std::string words;
  if (net) words = net.text(net.word(1) ? 1 : 0);
  auto found = std::ranges::find(sheet.nets, words);
  constexpr std::size_t most_nets = 4'000;  // that are looked through
  if (found == sheet.nets.end() && sheet.nets.size() < most_nets) {
    found = sheet.nets.insert(sheet.nets.end(), std::move(words));
  }
  const auto index = found == sheet.nets.end() ? 0 : found - sheet.nets.begin();
  sheet.image.pads.push_back({at, 0, static_cast<std::uint32_t>(index), text_.line_of(item)});
}

void KicadBoardReader::add_hole(KicadItem item, const KicadDrill& drill, const KicadFrame& frame, bool is_plated) {
  if (drill.across.count == 0) return;
  const std::uint32_t layer = is_plated ? 0 : 1;
  if (drill.across == drill.up) {
    drills_.holes.push_back({frame.at, drill.across, layer, text_.line_of(item)});
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
  drills_.paths.push_back(std::move(slot));
}

// A via goes through all copper from the one of its layers to the other.
void KicadBoardReader::read_via(KicadItem item) {
  const KicadFrame frame{kicad_frame(text_, item, {}).at, 0};
  const std::vector<Sheet*> ends = sheets_of(item);
  add_hole(item, kicad_drill(text_, item), frame, true);
  if (item.has("blind") || item.has("buried")) note_once("blind and buried vias are drilled through");
  if (ends.empty()) return;
  for (Sheet& one : sheets_) {
    if (&one < ends.front() || &one > ends.back()) continue;
    const KicadItem own = kicad_layer_of_padstack(item, one.name);
    KicadItem size = own ? own.find("size") : KicadItem();
    if (!size) size = item.find("size");
    if (!size) return text_.refuse(item, "kicad.bad-pad", "the via has no size", "(size DIAMETER)");
    const Nanometres diameter = text_.length(size, 0);
    if (diameter.count <= 0) continue;
    add(item, one, moved(disc_ring({}, static_cast<double>(diameter.count)), frame.at));
    add_flash(one, frame.at, item);
  }
}

void KicadBoardReader::read_pad(KicadItem item, const KicadFrame& around) {
  const KicadFrame hole = kicad_frame(text_, item, around);
  const KicadDrill drill = kicad_drill(text_, item);
  const bool is_bare = item.text(1) == "np_thru_hole";
  add_hole(item, drill, hole, !is_bare);
  if (item.has("remove_unused_layers") || item.has("remove_unused_layer")) {
    note_once("pads keep their copper on all layers, even where they are not connected");
  }
  for (Sheet* const one : sheets_of(item)) {
    const KicadPad pad = kicad_pad(text_, item, one->name);
    if (pad.rings.empty()) continue;
    // A hole with no more copper than the hole itself.
    if (is_bare && pad.is_round && pad.across == drill.across && pad.up == drill.up) continue;
    const KicadFrame shape{hole.placed(drill.offset), hole.degrees};
    for (const DrawnRing& ring : pad.rings) add(item, *one, shape.placed(ring));
    for (KicadGraphic graphic : pad.primitives) {
      for (PathPoint& point : graphic.path.points) point.at = shape.placed(point.at);
      if (graphic.is_filled || graphic.path.width.count > 0) {
        const std::size_t strokes = one->image.strokes.size();
        add_graphic(item, *one, graphic);
        one->image.strokes.resize(strokes);  // a part of the pad is no track
      }
    }
    add_flash(*one, hole.at, item);
  }
}

void KicadBoardReader::read_footprint(KicadItem item) {
  const KicadFrame frame = kicad_frame(text_, item, {});
  for (KicadItem part = item.first(); part && !is_full_ && !text_.full(); part = part.next()) {
    if (part.is("pad")) {
      read_pad(part, frame);
    } else if (part.is("zone")) {
      read_zone(part);
    } else if (part.is("fp_text") || part.is("fp_text_box") || part.is("property")) {
      const KicadItem hide = part.find("hide");
      const bool is_hidden = hide ? hide.text(0) != "no" : part.has("hide");
      if (is_hidden) continue;
      for (Sheet* const one : sheets_of(part)) ++one->texts;
    } else if (part.node().is_list && part.name().starts_with("fp_")) {
      read_graphic(part, frame);
    }
  }
}

// The ways of a fill that KiCad 4 and 5 made of lines, two points each, or one face.
void KicadBoardReader::read_fill(KicadItem item, Sheet& sheet, Nanometres width) {
  for (KicadItem pts = item.first(); pts; pts = pts.next()) {
    if (!pts.is("pts")) continue;
    DrawnPath path;
    path.points = kicad_points(text_, pts);
    path.width = width;
    if (path.points.size() < 2) continue;
    if (item.is("fill_segments")) {
      if (width.count > 0) add_stroke(item, sheet, path);
    } else {
      add_face(item, sheet, chords_of_path(path.points, true, gerber_tolerance), width);
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
  for (KicadItem part = item.first(); part && !is_full_; part = part.next()) {
    if (!part.is("filled_polygon") && !part.is("fill_segments")) continue;
    has_fill = true;
    for (Sheet* const one : sheets_of(part.find("layer") ? part : item)) read_fill(part, *one, width);
  }
  if (has_fill) return;
  for (Sheet* const one : sheets_of(item)) ++one->unfilled;
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
    for (Sheet* const one : sheets_of(item)) ++one->texts;
  } else if (name.starts_with("gr_")) {
    read_graphic(item, {});
  }
}

GerberLayer KicadBoardReader::layer_of(Sheet& sheet) {
  GerberLayer layer;
  layer.software = "KiCad";
  layer.function = "Copper";
  layer.apertures.emplace_back();
  layer.nets = std::move(sheet.nets);
  layer.pads = std::move(sheet.image.pads);
  layer.strokes.file = name_;
  layer.strokes.layers = {sheet.name};
  layer.strokes.paths = std::move(sheet.image.strokes);
  const auto note = [&](std::size_t count, const char* one, const char* more) {
    if (count == 1) layer.strokes.notes.emplace_back(one);
    if (count > 1) layer.strokes.notes.push_back(fmt::format(fmt::runtime(more), count));
  };
  note(sheet.texts, "a text on this layer is ignored", "{} texts on this layer are ignored");
  note(sheet.unfilled, "a zone is not filled: fill it in KiCad (key B) and save the board",
       "{} zones are not filled: fill them in KiCad (key B) and save the board");
  std::optional<Region> dark = composed(std::move(sheet.image), budget_);
  if (dark) {
    layer.dark = std::move(*dark);
  } else if (!diagnostics_.any_error()) {
    diagnostics_.add({.code = "kicad.too-large",
                      .file = name_,
                      .place = {},
                      .message = "the lines on " + sheet.name + " cross too often to be merged",
                      .expected = "a simpler board",
                      .text = ""});
  }
  return layer;
}

DesignBoard KicadBoardReader::read() {
  DesignBoard board;
  if (!text_.begins_with("kicad_pcb")) return board;
  while (!text_.full() && !is_full_) {
    const KicadItem item = text_.next();
    if (!item) break;
    read_item(item);
  }
  if (sheets_.empty() && !diagnostics_.any_error()) {
    diagnostics_.add({.code = "kicad.no-board",
                      .file = name_,
                      .place = {},
                      .message = "the board has no copper layer",
                      .expected = "(layers (0 \"F.Cu\" signal) ...)",
                      .text = ""});
  }
  for (Sheet& one : sheets_) {
    if (diagnostics_.any_error()) break;
    board.copper.push_back({one.name, layer_of(one)});
  }
  if (!diagnostics_.any_error()) {
    const std::vector<Region> lines = kicad_stroke_regions(edge_.strokes.paths);
    if (budget_.affords(lines)) edge_.dark = united(lines);
  }
  edge_.function = "Profile";
  edge_.software = "KiCad";
  drills_.notes = std::move(notes_);
  board.edge = std::move(edge_);
  board.drills = std::move(drills_);
  return board;
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
