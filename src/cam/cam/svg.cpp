#include "passo/cam/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "curve_chords.hpp"
#include "drawing_builder.hpp"
#include "svg_document.hpp"
#include "svg_path.hpp"
#include "svg_words.hpp"
#include "text_lines.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr int deepest_svg_use = 40;
constexpr std::size_t most_svg_work = 2'000'000;  // elements looked at while uses are expanded

struct SvgView {
  double width = 0;  // pixels; what 100 % is
  double height = 0;
};

// What of the view box lies where in a viewport of this size. `aspect`: preserveAspectRatio.
DxfTransform into_viewport(const std::array<double, 4>& box, const SvgView& port, std::string_view aspect) {
  double sx = port.width / box[2];
  double sy = port.height / box[3];
  double dx = 0;
  double dy = 0;
  if (!aspect.starts_with("none")) {
    const bool slices = aspect.find("slice") != std::string_view::npos;
    const double s = slices ? std::max(sx, sy) : std::min(sx, sy);
    const auto share = [&](const char* least, const char* most) {
      return aspect.find(least) != std::string_view::npos  ? 0.0
             : aspect.find(most) != std::string_view::npos ? 1.0
                                                           : 0.5;
    };
    sx = sy = s;
    dx = (port.width - s * box[2]) * share("xMin", "xMax");
    dy = (port.height - s * box[3]) * share("YMin", "YMax");
  }
  return {.xx = sx, .yy = sy, .dx = dx - sx * box[0], .dy = dy - sy * box[1]};
}

class SvgExpansion {
 public:
  SvgExpansion(const std::string& name, const SvgDocument& document, const SvgOptions& options,
               Diagnostics& diagnostics)
      : name_(name), document_(document), options_(options), diagnostics_(diagnostics), builder_(name, diagnostics) {}

  Drawing expand();

 private:
  struct Place {
    DxfTransform transform = {};
    SvgView view = {};
    std::uint32_t layer = 0;
    bool is_chosen = true;  // the layer is read
    int uses = 0;
  };

  void add(std::uint32_t index, const Place& outer);
  void add_children(const SvgElement& element, const Place& place);
  void add_use(const SvgElement& element, const Place& place);
  bool into_svg(const SvgElement& element, const SvgElement& sized, Place& place);
  void enter_layer(const SvgElement& element, Place& place);
  void draw(const SvgElement& element, const Place& place);
  bool draw_shape(const SvgElement& element, const Place& place);
  void draw_rect(const SvgElement& element, const Place& place);
  void draw_ellipse(const SvgElement& element, const Place& place, SvgSpot middle, double rx, double ry);
  void draw_points(const SvgElement& element, const Place& place);
  void draw_path(const SvgElement& element, const Place& place);
  void draw_subpath(const SvgElement& element, const Place& place, const SvgSubpath& subpath);

  double length(const SvgElement& element, std::string_view attribute, double whole, double otherwise = 0);
  bool put(DrawnPath& path, const SvgElement& element, const Place& place, SvgSpot spot, double bulge = 0);
  void put_arc(DrawnPath& path, const SvgElement& element, const Place& place, const SvgArc& arc);
  void put_curve(DrawnPath& path, const SvgElement& element, const Place& place, SvgSpot from, const SvgPiece& piece);
  void refuse(const SvgElement& element, std::string code, std::string message, std::string expected);
  static SourceLocation place_of(const SvgElement& element) { return {element.line, element.line == 0 ? 0U : 1U, 1}; }

  const std::string& name_;
  const SvgDocument& document_;
  const SvgOptions& options_;
  Diagnostics& diagnostics_;
  DrawingBuilder builder_;
  std::map<std::string, std::size_t> left_out_;
  std::size_t work_ = 0;
};

void SvgExpansion::refuse(const SvgElement& element, std::string code, std::string message, std::string expected) {
  diagnostics_.add({.code = std::move(code),
                    .file = name_,
                    .place = place_of(element),
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = ""});
}

double SvgExpansion::length(const SvgElement& element, std::string_view attribute, double whole, double otherwise) {
  const std::string_view text = element.attribute(attribute);
  if (text.empty() || text == "auto") return otherwise;
  const std::optional<double> value = svg_length(text, whole);
  if (value) return *value;
  refuse(element, "svg.length", fmt::format("'{}' is not a valid length ({})", text.substr(0, 40), attribute),
         "a number, with or without px, mm, cm, in, pt, pc or %");
  return otherwise;
}

// The inside of an svg or of a symbol: its place, its view box. `sized`: the element that tells the size, itself or the
// use. False: nothing of it is seen.
bool SvgExpansion::into_svg(const SvgElement& element, const SvgElement& sized, Place& place) {
  const double x = &element == &document_.elements.front() ? 0 : length(element, "x", place.view.width);
  const double y = &element == &document_.elements.front() ? 0 : length(element, "y", place.view.height);
  SvgView port{length(element, "width", place.view.width, place.view.width),
               length(element, "height", place.view.height, place.view.height)};
  if (&sized != &element) {
    port.width = length(sized, "width", place.view.width, port.width);
    port.height = length(sized, "height", place.view.height, port.height);
  }
  place.transform = place.transform.after(DxfTransform{.dx = x, .dy = y});
  std::array<double, 4> box{};
  SvgWords words(element.attribute("viewBox"));
  std::size_t count = 0;
  for (std::optional<double> value; count < 4 && (value = words.number());) box[count++] = *value;
  place.view = port;
  if (count < 4 || !(box[2] > 0) || !(box[3] > 0)) return port.width > 0 && port.height > 0;
  if (!(port.width > 0 && port.height > 0)) return false;
  place.transform = place.transform.after(into_viewport(box, port, element.attribute("preserveAspectRatio")));
  place.view = {box[2], box[3]};
  return true;
}

Drawing SvgExpansion::expand() {
  const SvgElement& root = document_.elements.front();
  const double pixel = 25.4 / 96 * options_.scale;
  SvgView page{};
  SvgWords words(root.attribute("viewBox"));
  std::array<double, 4> box{};
  for (double& value : box) value = words.number().value_or(0);
  page.width = length(root, "width", box[2], box[2]);
  page.height = length(root, "height", box[3], box[3]);
  if (page.width <= 0 && page.height > 0 && box[3] > 0) page.width = page.height * box[2] / box[3];
  if (page.height <= 0 && page.width > 0 && box[2] > 0) page.height = page.width * box[3] / box[2];
  const bool has_page = page.width > 0 && page.height > 0;
  if (!has_page) {
    page = {300, 150};
    builder_.note("the drawing has no size: its unit is read as a pixel (1/96 inch), and its zero is X0 Y0");
  }
  Place place{.transform = {.xx = pixel, .yy = -pixel, .dy = has_page ? pixel * page.height : 0},
              .view = page,
              .layer = builder_.layer(""),
              .is_chosen = options_.layers.empty()};
  // The size of the page is that of the view box where the root says none.
  if (box[2] > 0 && box[3] > 0) {
    place.transform = place.transform.after(into_viewport(box, page, root.attribute("preserveAspectRatio")));
    place.view = {box[2], box[3]};
  }
  if (const auto own = svg_transform(root.attribute("transform"))) place.transform = place.transform.after(*own);
  add_children(root, place);
  for (const auto& [what, count] : left_out_) builder_.note(fmt::format("ignored: {} {}", count, what));
  for (const std::string& layer : options_.layers) {
    if (std::ranges::find(builder_.drawing().layers, layer) == builder_.drawing().layers.end()) {
      builder_.note(fmt::format("there is no layer '{}'", layer));
    }
  }
  return builder_.take();
}

void SvgExpansion::add_children(const SvgElement& element, const Place& place) {
  for (const std::uint32_t child : element.children) {
    add(child, place);
    // Of a switch the first one is drawn.
    if (element.name == "switch" && document_.elements[child].name != "foreignObject") return;
  }
}

void SvgExpansion::enter_layer(const SvgElement& element, Place& place) {
  if (element.attribute("inkscape:groupmode") != "layer") return;
  const std::string_view label = element.attribute("inkscape:label");
  const std::string name(label.empty() ? element.attribute("id") : label);
  place.layer = builder_.layer(name);
  if (!options_.layers.empty()) place.is_chosen = std::ranges::find(options_.layers, name) != options_.layers.end();
}

void SvgExpansion::add(std::uint32_t index, const Place& outer) {
  if (builder_.is_full() || diagnostics_.full()) return;
  const SvgElement& element = document_.elements[index];
  if (++work_ > most_svg_work) {
    if (work_ == most_svg_work + 1) {
      refuse(element, "svg.too-large", "the <use> elements of this drawing expand to too many elements",
             "fewer <use> elements");
    }
    return;
  }
  if (element.property("display") == "none") {
    ++left_out_["elements that are not displayed"];
    return;
  }
  Place place = outer;
  const std::string_view transform = element.attribute("transform");
  if (!transform.empty()) {
    const std::optional<DxfTransform> own = svg_transform(transform);
    if (!own) {
      refuse(element, "svg.transform", fmt::format("'{}' is not a valid transform", transform.substr(0, 60)),
             "matrix, translate, scale, rotate, skewX or skewY, with their numbers");
      return;
    }
    place.transform = place.transform.after(*own);
  }
  if (element.name == "g" || element.name == "a" || element.name == "switch") {
    enter_layer(element, place);
    add_children(element, place);
  } else if (element.name == "svg") {
    if (into_svg(element, element, place)) add_children(element, place);
  } else if (element.name == "use") {
    add_use(element, place);
  } else {
    draw(element, place);
  }
}

void SvgExpansion::add_use(const SvgElement& element, const Place& outer) {
  const std::string_view link = element.attribute("href");
  const auto found = link.starts_with('#') ? document_.ids.find(std::string(link.substr(1))) : document_.ids.end();
  if (found == document_.ids.end()) {
    refuse(element, "svg.no-element",
           fmt::format("this <use> refers to an element that the drawing does not have: '{}'", link.substr(0, 60)),
           "'#' and the id of an element");
    return;
  }
  if (outer.uses >= deepest_svg_use) {
    refuse(element, "svg.nested-too-deep", fmt::format("<use> elements are nested more than {} deep", deepest_svg_use),
           "<use> elements that do not contain themselves");
    return;
  }
  Place place = outer;
  ++place.uses;
  const DxfTransform moved{.dx = length(element, "x", place.view.width), .dy = length(element, "y", place.view.height)};
  place.transform = place.transform.after(moved);
  const SvgElement& used = document_.elements[found->second];
  if (used.name == "symbol") {
    if (used.property("display") != "none" && into_svg(used, element, place)) add_children(used, place);
  } else {
    add(found->second, place);
  }
}

void SvgExpansion::draw(const SvgElement& element, const Place& place) {
  if (!place.is_chosen) return;
  const std::string_view visibility = element.property("visibility");
  if (visibility == "hidden" || visibility == "collapse") {
    ++left_out_["elements that are not displayed"];
    return;
  }
  if (draw_shape(element, place)) return;
  if (element.name == "text") ++left_out_["texts (convert them to paths)"];
  if (element.name == "image" || element.name == "foreignObject") ++left_out_["pictures and foreign objects"];
}

bool SvgExpansion::draw_shape(const SvgElement& element, const Place& place) {
  const std::string& name = element.name;
  const double diagonal = std::hypot(place.view.width, place.view.height) / std::numbers::sqrt2;
  const auto x = [&](const char* attribute) { return length(element, attribute, place.view.width); };
  const auto y = [&](const char* attribute) { return length(element, attribute, place.view.height); };
  if (name == "path") {
    draw_path(element, place);
  } else if (name == "rect") {
    draw_rect(element, place);
  } else if (name == "circle") {
    const double radius = length(element, "r", diagonal);
    draw_ellipse(element, place, {x("cx"), y("cy")}, radius, radius);
  } else if (name == "ellipse") {
    const double rx = length(element, "rx", place.view.width, -1);
    const double ry = length(element, "ry", place.view.height, rx);
    draw_ellipse(element, place, {x("cx"), y("cy")}, rx < 0 ? ry : rx, ry);
  } else if (name == "line") {
    DrawnPath path{.layer = place.layer, .line = element.line};
    if (put(path, element, place, {x("x1"), y("y1")}) && put(path, element, place, {x("x2"), y("y2")})) {
      builder_.add_path(std::move(path));
    }
  } else if (name == "polyline" || name == "polygon") {
    draw_points(element, place);
  } else {
    return false;
  }
  return true;
}

bool SvgExpansion::put(DrawnPath& path, const SvgElement& element, const Place& place, SvgSpot spot, double bulge) {
  if (!builder_.has_room_for(1, place_of(element), "")) return false;
  const auto at = builder_.point(Mm(place.transform.x(spot.x, spot.y)), Mm(place.transform.y(spot.x, spot.y)),
                                 place_of(element), "");
  if (at) path.points.push_back({*at, bulge});
  return at.has_value();
}

// From the end of the path on. A circle that is not stretched stays one.
void SvgExpansion::put_arc(DrawnPath& path, const SvgElement& element, const Place& place, const SvgArc& arc) {
  const double a = std::hypot(arc.major.x, arc.major.y);
  const double b = std::hypot(arc.minor.x, arc.minor.y);
  const double scale = place.transform.uniform_scale();
  const bool is_circle = std::abs(a - b) <= 1e-9 * (a + b) && scale > 0;
  const double largest = std::max(a, b) * place.transform.largest_scale();
  const double share = std::clamp(options_.tolerance.value() / std::max(largest, 1e-9), 1e-9, 0.5);
  const double most = is_circle ? std::numbers::pi * 1.0001 : 2 * std::acos(1 - share);
  const auto parts = static_cast<std::size_t>(std::max(1.0, std::ceil(std::abs(arc.sweep) / most)));
  // Seen with Y up a positive angle of SVG turns clockwise; a mirroring turns it once more.
  double bulge = 0;
  if (is_circle)
    bulge = std::tan(arc.sweep / static_cast<double>(parts) / 4) * (place.transform.is_mirrored() ? -1 : 1);
  if (!builder_.has_room_for(parts, place_of(element), "")) return;
  for (std::size_t i = 1; i <= parts; ++i) {
    if (!path.points.empty()) path.points.back().bulge = bulge;
    if (!put(path, element, place, arc.at(arc.start + arc.sweep * static_cast<double>(i) / static_cast<double>(parts))))
      return;
  }
}

void SvgExpansion::put_curve(DrawnPath& path, const SvgElement& element, const Place& place, SvgSpot from,
                             const SvgPiece& piece) {
  std::vector<SvgSpot> points = {from};
  points.insert(points.end(), piece.control.begin(), piece.control.end());
  points.push_back(piece.end);
  const auto take = [&](double x, double y) { return put(path, element, place, {x, y}); };
  const double scale = place.transform.largest_scale();
  if (for_chords(std::span<const SvgSpot>(points), scale, options_.tolerance.value(), take)) return;
  refuse(element, "svg.path", "this curve is too large", "curves of at most a few metres");
}

void SvgExpansion::draw_ellipse(const SvgElement& element, const Place& place, SvgSpot middle, double rx, double ry) {
  if (!(rx > 0 && ry > 0)) return;
  const double scale = place.transform.uniform_scale();
  if (rx == ry && scale > 0) {
    const auto at = builder_.point(Mm(place.transform.x(middle.x, middle.y)), Mm(place.transform.y(middle.x, middle.y)),
                                   place_of(element), "");
    const auto diameter = builder_.length(Mm(2 * rx * scale), place_of(element), "");
    if (at && diameter && builder_.has_room_for(1, place_of(element), "")) {
      builder_.add_hole({*at, *diameter, place.layer, element.line});
    }
    return;
  }
  DrawnPath path{.is_closed = true, .layer = place.layer, .line = element.line};
  put_arc(path, element, place, {middle, {rx, 0}, {0, ry}, 0, 2 * std::numbers::pi});
  builder_.add_path(std::move(path));
}

void SvgExpansion::draw_rect(const SvgElement& element, const Place& place) {
  const double x = length(element, "x", place.view.width);
  const double y = length(element, "y", place.view.height);
  const double width = length(element, "width", place.view.width);
  const double height = length(element, "height", place.view.height);
  if (!(width > 0 && height > 0)) return;
  double rx = length(element, "rx", place.view.width, -1);
  double ry = length(element, "ry", place.view.height, -1);
  if (rx < 0) rx = ry;
  if (ry < 0) ry = rx;
  rx = std::clamp(rx, 0.0, width / 2);
  ry = std::clamp(ry, 0.0, height / 2);
  DrawnPath path{.is_closed = true, .layer = place.layer, .line = element.line};
  const bool is_round = rx > 0 && ry > 0;
  // Each corner: where its arc's centre is, and at which angle the arc begins.
  const std::array<SvgSpot, 4> corners = {{{x + width, y}, {x + width, y + height}, {x, y + height}, {x, y}}};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!is_round) {
      put(path, element, place, corners[i]);
      continue;
    }
    const double start = (static_cast<double>(i) - 1) * std::numbers::pi / 2;
    const SvgSpot centre{corners[i].x + (i == 0 || i == 1 ? -rx : rx), corners[i].y + (i == 0 || i == 3 ? ry : -ry)};
    const SvgArc arc{centre, {rx, 0}, {0, ry}, start, std::numbers::pi / 2};
    put(path, element, place, arc.at(start));
    put_arc(path, element, place, arc);
  }
  // The sides between two arcs may have no length.
  std::vector<PathPoint> points;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const bool is_again =
        path.points[i].at == path.points[(i + 1) % path.points.size()].at && path.points[i].bulge == 0;
    if (!is_again) points.push_back(path.points[i]);
  }
  path.points = std::move(points);
  builder_.add_path(std::move(path));
}

void SvgExpansion::draw_points(const SvgElement& element, const Place& place) {
  DrawnPath path{.is_closed = element.name == "polygon", .layer = place.layer, .line = element.line};
  SvgWords words(element.attribute("points"));
  while (!words.at_end()) {
    const std::optional<double> x = words.number();
    const std::optional<double> y = x ? words.number() : std::nullopt;
    if (!y) {
      refuse(element, "svg.path", "these points are not pairs of numbers", "x,y x,y ...");
      return;
    }
    if (!put(path, element, place, {*x, *y})) return;
  }
  builder_.add_path(std::move(path));
}

void SvgExpansion::draw_path(const SvgElement& element, const Place& place) {
  const std::string_view data = element.attribute("d");
  std::vector<SvgSubpath> subpaths;
  if (const auto flaw = read_svg_path(data, most_drawn, subpaths)) {
    const std::size_t from = flaw->place < 20 ? 0 : flaw->place - 20;
    refuse(element, "svg.path",
           fmt::format("the path data is wrong at character {}: '{}'", flaw->place + 1, data.substr(from, 40)),
           flaw->expected);
    return;
  }
  for (const SvgSubpath& subpath : subpaths) draw_subpath(element, place, subpath);
}

void SvgExpansion::draw_subpath(const SvgElement& element, const Place& place, const SvgSubpath& subpath) {
  DrawnPath path{.is_closed = subpath.is_closed, .layer = place.layer, .line = element.line};
  if (!put(path, element, place, subpath.start)) return;
  SvgSpot at = subpath.start;
  for (const SvgPiece& piece : subpath.pieces) {
    if (piece.arc) {
      put_arc(path, element, place, *piece.arc);
    } else if (!piece.control.empty()) {
      put_curve(path, element, place, at, piece);
    } else {
      put(path, element, place, piece.end);
    }
    at = piece.end;
  }
  if (path.is_closed && path.points.size() > 2 && path.points.back().at == path.points.front().at)
    path.points.pop_back();
  builder_.add_path(std::move(path));
}

}  // namespace

Drawing read_svg(const std::string& name, std::string_view text, const SvgOptions& options, Diagnostics& diagnostics) {
  const SvgDocument document = read_svg_document(name, text, diagnostics);
  if (document.elements.empty()) {
    Drawing nothing;
    nothing.file = name;
    return nothing;
  }
  return SvgExpansion(name, document, options, diagnostics).expand();
}

bool looks_like_svg(std::string_view text) {
  constexpr std::size_t looked_at = 4096;
  text = text.substr(0, looked_at);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '<' && text.find("svg") != std::string_view::npos;
}

}  // namespace passo
