// Reads a board of EAGLE 6 and newer. Lengths are in mm; Y points up. A package is first rotated, then mirrored, then
// moved to the position of its element.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "copper_builder.hpp"
#include "design_readers.hpp"
#include "eagle_document.hpp"
#include <fmt/format.h>

#include "passo/base/read_double.hpp"
#include "passo/cam/bulge.hpp"
#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

constexpr int eagle_bottom = 16;
constexpr int eagle_dimension = 20;
constexpr int eagle_milling = 46;
constexpr double degree = std::numbers::pi / 180;

// A position, and a rotation such as "MR90".
struct EagleFrame {
  DrawnPoint at = {};
  double degrees = 0;
  bool is_mirrored = false;

  DrawnPoint placed(DrawnPoint local) const {
    const Offset turned_one = turned(offset_of(local), degrees * degree);
    const DrawnPoint rounded_one = rounded({is_mirrored ? -turned_one.x : turned_one.x, turned_one.y});
    return moved(rounded_one, at);
  }
  DrawnRing placed(DrawnRing ring) const {
    for (DrawnPoint& point : ring) point = placed(point);
    if (is_mirrored) std::ranges::reverse(ring);
    return ring;
  }
};

// The widths of the annular rings, from the design rules.
struct EagleRing {
  double share = 0.25;  // of the hole
  Nanometres least{254'000};
  Nanometres most{508'000};

  Nanometres around(Nanometres drill) const {
    const auto wide = static_cast<std::int64_t>(std::llround(static_cast<double>(drill.count) * share));
    return {drill.count + 2 * std::clamp(wide, least.count, std::max(least.count, most.count))};
  }
};

class EagleBoardReader {
 public:
  EagleBoardReader(const std::string& name, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), builder_(name, "eagle", "EAGLE", "Dimension", diagnostics) {}

  DesignBoard read(const EagleItem& board);

 private:
  double number(const EagleItem& item, std::string_view attribute, double missing);
  Nanometres length(const EagleItem& item, std::string_view attribute, double missing = 0);
  DrawnPoint point(const EagleItem& item, std::string_view x = "x", std::string_view y = "y");
  EagleFrame frame(const EagleItem& item);
  Nanometres rule(const EagleItem& rules, std::string_view name, Nanometres missing);
  void read_rules(const EagleItem& board);
  void find_sheets(const EagleItem& board);
  void note_layer(const EagleItem& item);
  void find_pads(const EagleItem& board);
  void read_figure(const EagleItem& item, const EagleFrame& frame, const std::string& net);
  void read_wire(const EagleItem& item, const EagleFrame& frame, int layer, const std::string& net);
  void read_polygon(const EagleItem& item, const EagleFrame& frame, int layer, const std::string& net);
  void read_package(const EagleItem& package, const EagleItem& element);
  void read_pad(const EagleItem& item, const EagleFrame& frame, const std::string& net);
  void read_smd(const EagleItem& item, const EagleFrame& frame, const std::string& net);
  void read_via(const EagleItem& item, const std::string& net);
  DrawnRing pad_ring(std::string_view shape, Nanometres across) const;
  const std::size_t* sheet_of(int layer) const {
    const auto found = sheets_.find(layer);
    return found == sheets_.end() ? nullptr : &found->second;
  }
  std::string net_of(const EagleItem& element, const EagleItem& pad) const {
    const auto found = nets_.find(std::string(element.text("name")) + '\n' + std::string(pad.text("name")));
    return found == nets_.end() ? std::string() : found->second;
  }

  Diagnostics& diagnostics_;
  CopperBuilder builder_;
  std::map<int, std::size_t> sheets_;        // by the number of the layer
  std::map<std::string, std::string> nets_;  // of "element\npad"
  EagleRing pad_ring_;
  EagleRing via_ring_;
  Nanometres isolate_{203'200};
  Nanometres edge_distance_{1'016'000};
  double elongation_ = 1;  // of long pads
};

double EagleBoardReader::number(const EagleItem& item, std::string_view attribute, double missing) {
  const std::string_view text = item.text(attribute);
  if (text.empty()) return missing;
  double value = 0;
  const auto [end, error] = read_double(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return value;
  builder_.refuse("bad-number", item.line, fmt::format("{}=\"{}\" of <{}> is no number", attribute, text, item.name),
                  "a number");
  return missing;
}

Nanometres EagleBoardReader::length(const EagleItem& item, std::string_view attribute, double missing) {
  const double mm = number(item, attribute, missing);
  constexpr double farthest = 10'000;  // mm
  if (std::abs(mm) <= farthest) return to_nanometres(Mm(mm));
  builder_.refuse("bad-number", item.line, fmt::format("{}=\"{}\" is too far away", attribute, item.text(attribute)),
                  "at most 10 m");
  return {};
}

DrawnPoint EagleBoardReader::point(const EagleItem& item, std::string_view x, std::string_view y) {
  return {length(item, x), length(item, y)};
}

// "R90", "MR180", "SMR45": S keeps texts upright.
EagleFrame EagleBoardReader::frame(const EagleItem& item) {
  EagleFrame frame{point(item)};
  const std::string_view rot = item.text("rot");
  const std::size_t r = rot.find('R');
  if (r == std::string_view::npos) return frame;
  frame.is_mirrored = rot.substr(0, r).find('M') != std::string_view::npos;
  double value = 0;
  const auto [end, error] = read_double(rot.data() + r + 1, rot.data() + rot.size(), value);
  if (error != std::errc() || std::abs(value) > 360) {
    builder_.refuse("bad-number", item.line, fmt::format("rot=\"{}\" is no angle", rot), "e.g. R90 or MR180");
  } else {
    frame.degrees = value;
  }
  return frame;
}

// "10mil", "0.25mm", "0.5".
Nanometres EagleBoardReader::rule(const EagleItem& rules, std::string_view name, Nanometres missing) {
  for (const EagleItem& item : rules.children) {
    if (item.name != "param" || item.text("name") != name) continue;
    const std::string_view text = item.text("value");
    double value = 0;
    const auto [end, error] = read_double(text.data(), text.data() + text.size(), value);
    const std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
    const double mm = unit == "mil" ? 0.0254 : unit == "inch" ? 25.4 : unit == "mic" ? 0.001 : 1;
    if (error == std::errc() && std::abs(value * mm) < 1'000) return to_nanometres(Mm(value * mm));
  }
  return missing;
}

void EagleBoardReader::read_rules(const EagleItem& board) {
  const EagleItem* const rules = board.child("designrules");
  if (rules == nullptr) return;
  const auto share = [&](std::string_view name, double missing) {
    return to_mm(rule(*rules, name, to_nanometres(Mm(missing)))).value();
  };
  pad_ring_ = {share("rvPadTop", 0.25), rule(*rules, "rlMinPadTop", pad_ring_.least),
               rule(*rules, "rlMaxPadTop", pad_ring_.most)};
  via_ring_ = {share("rvViaOuter", 0.25), rule(*rules, "rlMinViaOuter", via_ring_.least),
               rule(*rules, "rlMaxViaOuter", via_ring_.most)};
  isolate_ = std::max(rule(*rules, "mdWireWire", isolate_), Nanometres{1'000});
  edge_distance_ = std::max(rule(*rules, "mdCopperDimension", edge_distance_), Nanometres{});
  elongation_ = share("psElongationLong", 100) / 100;
}

void EagleBoardReader::note_layer(const EagleItem& item) {
  const std::string_view text = item.text("layer");
  int layer = 0;
  std::from_chars(text.data(), text.data() + text.size(), layer);
  if (layer >= 1 && layer <= eagle_bottom) sheets_.try_emplace(layer, 0);
  for (const EagleItem& child : item.children) note_layer(child);
}

// Top, bottom, and the inner layers that are not empty.
void EagleBoardReader::find_sheets(const EagleItem& board) {
  sheets_ = {{1, 0}, {eagle_bottom, 0}};
  note_layer(board);
  for (auto& [layer, sheet] : sheets_) {
    sheet = builder_.add_sheet(layer == 1 ? "Top" : layer == eagle_bottom ? "Bottom" : fmt::format("Route{}", layer));
  }
}

void EagleBoardReader::find_pads(const EagleItem& board) {
  const EagleItem* const signals = board.child("signals");
  if (signals == nullptr) return;
  for (const EagleItem& signal : signals->children) {
    for (const EagleItem& item : signal.children) {
      if (item.name != "contactref") continue;
      nets_[std::string(item.text("element")) + '\n' + std::string(item.text("pad"))] = signal.text("name");
    }
  }
}

void EagleBoardReader::read_wire(const EagleItem& item, const EagleFrame& frame, int layer, const std::string& net) {
  DrawnPath path;
  const double curve = number(item, "curve", 0);
  if (std::abs(curve) >= 360) {
    builder_.refuse("bad-number", item.line, "the curve of the wire is a full circle or more", "-359 to 359 degrees");
    return;
  }
  const double bulge = std::tan(curve / 4 * degree);
  path.points = {{frame.placed(point(item, "x1", "y1")), frame.is_mirrored ? -bulge : bulge},
                 {frame.placed(point(item, "x2", "y2")), 0}};
  path.width = length(item, "width");
  path.line = item.line;
  if (layer == eagle_dimension) return builder_.add_edge(std::move(path));
  if (const std::size_t* const sheet = sheet_of(layer)) builder_.add_stroke(*sheet, net, path, item.line);
}

void EagleBoardReader::read_polygon(const EagleItem& item, const EagleFrame& frame, int layer, const std::string& net) {
  std::vector<PathPoint> points;
  for (const EagleItem& vertex : item.children) {
    if (vertex.name != "vertex") continue;
    const double curve = std::clamp(number(vertex, "curve", 0), -359.0, 359.0);
    const double bulge = std::tan(curve / 4 * degree);
    points.push_back({frame.placed(point(vertex)), frame.is_mirrored ? -bulge : bulge});
  }
  if (points.size() < 3) return;
  DrawnRing ring = chords_of_path(points, true, gerber_tolerance);
  if (layer == eagle_dimension) {
    builder_.add_edge({.points = std::move(points), .is_closed = true, .width = length(item, "width")});
    return;
  }
  const std::size_t* const sheet = sheet_of(layer);
  if (sheet == nullptr) return;
  if (item.text("pour") == "cutout") return builder_.add_cutout(*sheet, std::move(ring));
  if (net.empty()) {  // outside of signals a polygon is drawn as it is
    DrawnPath rim{.points = std::move(points), .is_closed = true, .width = length(item, "width")};
    builder_.add_stroke(*sheet, net, rim, item.line);
    return builder_.add_face(*sheet, net, std::move(ring), item.line);
  }
  builder_.add_pour(*sheet, net,
                    {.outline = std::move(ring),
                     .width = std::max(length(item, "width"), Nanometres{}),
                     .isolate = std::max(length(item, "isolate"), isolate_),
                     .edge_distance = edge_distance_,
                     .rank = static_cast<int>(std::clamp(number(item, "rank", 1), 0.0, 10.0))});
}

// The shapes on the board, in a package or in a signal.
void EagleBoardReader::read_figure(const EagleItem& item, const EagleFrame& frame, const std::string& net) {
  if (item.name == "hole") {
    return builder_.add_hole({frame.placed(point(item)), length(item, "drill"), 1, item.line});
  }
  int layer = static_cast<int>(std::clamp(number(item, "layer", 0), 0.0, 255.0));
  if (frame.is_mirrored && layer >= 1 && layer <= eagle_bottom) layer = eagle_bottom + 1 - layer;
  if (layer == eagle_milling) builder_.note_once("lines on the layer Milling are ignored");
  const std::size_t* const sheet = sheet_of(layer);
  if (sheet == nullptr && layer != eagle_dimension) return;
  if (item.name == "wire") {
    read_wire(item, frame, layer, net);
  } else if (item.name == "polygon") {
    read_polygon(item, frame, layer, net);
  } else if (item.name == "circle") {
    const DrawnPoint centre = point(item);
    const Nanometres radius = length(item, "radius");
    DrawnPath path{
        .points = {{frame.placed({centre.x - radius, centre.y}), 1}, {frame.placed({centre.x + radius, centre.y}), 1}},
        .is_closed = true,
        .width = length(item, "width")};
    if (layer == eagle_dimension) return builder_.add_edge(std::move(path));
    if (path.width.count > 0) return builder_.add_stroke(*sheet, net, path, item.line);
    builder_.add_face(*sheet, net, chords_of_path(path.points, true, gerber_tolerance), item.line);
  } else if (item.name == "rectangle" && sheet != nullptr) {
    const DrawnPoint a = point(item, "x1", "y1");
    const DrawnPoint b = point(item, "x2", "y2");
    EagleFrame own = this->frame(item);  // it is turned about its middle
    own.at = {{(a.x.count + b.x.count) / 2}, {(a.y.count + b.y.count) / 2}};
    const auto across = static_cast<double>(std::abs(b.x.count - a.x.count));
    const auto up = static_cast<double>(std::abs(b.y.count - a.y.count));
    builder_.add_face(*sheet, net, frame.placed(own.placed(rectangle_ring({}, across, up))), item.line);
  } else if (item.name == "text" && sheet != nullptr) {
    builder_.add_text(*sheet);
  }
}

DrawnRing EagleBoardReader::pad_ring(std::string_view shape, Nanometres across) const {
  const auto wide = static_cast<double>(across.count);
  if (shape == "square") return rectangle_ring({}, wide, wide);
  if (shape == "octagon") {
    constexpr double eighth = std::numbers::pi / 8;
    return regular_ring({}, wide / std::cos(eighth), 8, eighth);
  }
  if (shape == "long" || shape == "offset") {
    DrawnRing ring = obround_ring(wide * (1 + elongation_), wide);
    if (shape == "offset") ring = moved(ring, {{std::llround(wide * elongation_ / 2)}, {}});
    return ring;
  }
  return disc_ring({}, wide);
}

void EagleBoardReader::read_pad(const EagleItem& item, const EagleFrame& frame, const std::string& net) {
  const EagleFrame own = this->frame(item);
  const Nanometres drill = length(item, "drill");
  const DrawnPoint at = frame.placed(own.at);
  const Nanometres across = std::max(length(item, "diameter"), pad_ring_.around(drill));
  builder_.add_hole({at, drill, 0, item.line});
  const DrawnRing ring = frame.placed(own.placed(pad_ring(item.text("shape"), across)));
  for (std::size_t sheet = 0; sheet < builder_.sheets(); ++sheet) {
    builder_.add_face(sheet, net, ring, item.line);
    builder_.add_place(sheet, net, at, item.line);
  }
}

void EagleBoardReader::read_smd(const EagleItem& item, const EagleFrame& frame, const std::string& net) {
  const bool is_bottom = (number(item, "layer", 1) == eagle_bottom) != frame.is_mirrored;
  const std::size_t sheet = sheets_.at(is_bottom ? eagle_bottom : 1);
  const EagleFrame own = this->frame(item);
  const auto across = static_cast<double>(length(item, "dx").count);
  const auto up = static_cast<double>(length(item, "dy").count);
  if (across <= 0 || up <= 0) return;
  const double radius = std::clamp(number(item, "roundness", 0), 0.0, 100.0) / 200 * std::min(across, up);
  DrawnRing ring = rectangle_ring({}, across, up);
  if (radius > 0) {
    std::vector<DrawnRing> corners;
    for (const double x : {-1, 1}) {
      for (const double y : {-1, 1})
        corners.push_back(disc_ring({x * (across / 2 - radius), y * (up / 2 - radius)}, 2 * radius));
    }
    ring = hull_of(corners);
  }
  builder_.add_face(sheet, net, frame.placed(own.placed(ring)), item.line);
  builder_.add_place(sheet, net, frame.placed(own.at), item.line);
}

void EagleBoardReader::read_via(const EagleItem& item, const std::string& net) {
  const Nanometres drill = length(item, "drill");
  const DrawnPoint at = point(item);
  builder_.add_hole({at, drill, 0, item.line});
  const std::string_view extent = item.text("extent");
  int from = 1;
  int to = eagle_bottom;
  const auto [dash, error] = std::from_chars(extent.data(), extent.data() + extent.size(), from);
  if (error == std::errc() && dash != extent.data() + extent.size())
    std::from_chars(dash + 1, extent.data() + extent.size(), to);
  if (from > 1 || to < eagle_bottom) builder_.note_once("blind and buried vias are drilled through");
  const Nanometres across = std::max(length(item, "diameter"), via_ring_.around(drill));
  const DrawnRing ring = moved(pad_ring(item.text("shape"), across), at);
  for (const auto& [layer, sheet] : sheets_) {
    if (layer < from || layer > to) continue;
    builder_.add_face(sheet, net, ring, item.line);
    builder_.add_place(sheet, net, at, item.line);
  }
}

void EagleBoardReader::read_package(const EagleItem& package, const EagleItem& element) {
  const EagleFrame at = frame(element);
  for (const EagleItem& item : package.children) {
    if (diagnostics_.any_error() || builder_.is_full()) return;
    if (item.name == "pad") {
      read_pad(item, at, net_of(element, item));
    } else if (item.name == "smd") {
      read_smd(item, at, net_of(element, item));
    } else {
      read_figure(item, at, "");
    }
  }
}

DesignBoard EagleBoardReader::read(const EagleItem& board) {
  read_rules(board);
  find_sheets(board);
  find_pads(board);
  std::map<std::string, const EagleItem*> packages;  // by "library\npackage"
  if (const EagleItem* const libraries = board.child("libraries")) {
    for (const EagleItem& library : libraries->children) {
      const EagleItem* const of_library = library.child("packages");
      if (of_library == nullptr) continue;
      const std::string urn(library.text("urn"));
      for (const EagleItem& package : of_library->children) {
        const std::string name = '\n' + std::string(package.text("name"));
        packages.try_emplace(std::string(library.text("name")) + name, &package);
        if (!urn.empty()) packages[urn + name] = &package;
      }
    }
  }
  if (const EagleItem* const plain = board.child("plain")) {
    for (const EagleItem& item : plain->children) read_figure(item, {}, "");
  }
  if (const EagleItem* const elements = board.child("elements")) {
    for (const EagleItem& element : elements->children) {
      const std::string name = '\n' + std::string(element.text("package"));
      auto found = packages.find(std::string(element.text("library_urn")) + name);
      if (found == packages.end()) found = packages.find(std::string(element.text("library")) + name);
      if (found != packages.end()) {
        read_package(*found->second, element);
      } else if (element.name == "element") {
        builder_.refuse(
            "no-package", element.line,
            fmt::format("the package '{}' of {} is not in the file", element.text("package"), element.text("name")),
            "a board saved by EAGLE");
      }
    }
  }
  if (const EagleItem* const signals = board.child("signals")) {
    for (const EagleItem& signal : signals->children) {
      const std::string net(signal.text("name"));
      for (const EagleItem& item : signal.children) {
        if (diagnostics_.any_error() || builder_.is_full()) break;
        if (item.name == "via") {
          read_via(item, net);
        } else if (item.name != "contactref") {
          read_figure(item, {}, net);
        }
      }
    }
  }
  return builder_.take();
}

}  // namespace

bool looks_like_eagle_board(std::string_view text) {
  constexpr std::size_t beginning = 4'096;
  const std::string_view begin = text.substr(0, beginning);
  return begin.find("<eagle ") != std::string_view::npos;
}

DesignBoard read_eagle_board(const std::string& name, std::string_view text, Diagnostics& diagnostics) {
  const std::optional<EagleItem> board = read_eagle_document(name, text, diagnostics);
  return board ? EagleBoardReader(name, diagnostics).read(*board) : DesignBoard{};
}

}  // namespace passo
