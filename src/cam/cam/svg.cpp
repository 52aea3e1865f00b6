#include "passo/cam/svg.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "svg_clip.hpp"
#include "svg_figure.hpp"
#include "svg_selection.hpp"
#include "svg_style.hpp"
#include "svg_words.hpp"
#include <fmt/format.h>

#include "passo/base/trimmed.hpp"

namespace passo {
namespace {

constexpr int deepest_svg_use = 40;
constexpr std::size_t most_svg_work = 2'000'000;  // elements looked at while uses are expanded

// Inkscape's pixel was 1/90 inch until version 0.91.
double inch_of(const SvgDocument& document) {
  constexpr double of_old_inkscape = 90;
  const std::string& version = document.inkscape_version;
  int minor = 0;
  if (!version.starts_with("0.")) return svg_inch;
  const auto [end, fault] = std::from_chars(version.data() + 2, version.data() + version.size(), minor);
  constexpr int first_with_96 = 92;
  return fault == std::errc() && minor < first_with_96 ? of_old_inkscape : svg_inch;
}

class SvgExpansion {
 public:
  SvgExpansion(const std::string& name, const SvgDocument& document, const SvgOptions& options,
               Diagnostics& diagnostics)
      : document_(document),
        options_(options),
        diagnostics_(diagnostics),
        builder_(name, diagnostics),
        inch_(inch_of(document)),
        reader_(name, options.tolerance, inch_, builder_, diagnostics),
        selection_(options) {}

  Drawing expand();

 private:
  struct Place : SvgSpace {
    bool is_chosen = true;  // the layer is read
    bool is_visible = true;
    SvgSelection::Paint paint = {};
    int uses = 0;
    std::shared_ptr<const SvgClip> clip = nullptr;  // null: everything is drawn
  };

  void expand_root(const SvgElement& root);
  void add(std::uint32_t index, const Place& outer);
  void add_children(const SvgElement& element, const Place& place);
  void add_use(const SvgElement& element, const Place& place);
  bool into_svg(const SvgElement& element, const SvgElement& sized, Place& place);
  void enter_layer(const SvgElement& element, Place& place);
  bool is_displayed(const SvgElement& element, Place& place);
  bool transform(const SvgElement& element, Place& place);
  void draw(const SvgElement& element, const Place& place);
  void put(SvgFigure figure, const SvgElement& element, const Place& place);

  void clip(std::uint32_t index, Place& place);
  void clip(const Region& area, const SvgElement& element, Place& place);
  std::optional<Region> clip_area(const SvgElement& element, const SvgElement& clip_path, const Place& place);
  std::optional<DrawnBox> box_of_content(const SvgElement& element, const Place& place);
  void note_what_is_left_out();

  double length(const SvgElement& element, std::string_view attribute, double whole, double otherwise = 0) {
    return reader_.length(element, attribute, whole, otherwise);
  }
  void refuse(const SvgElement& element, std::string code, std::string message, std::string expected) {
    reader_.refuse(element, std::move(code), std::move(message), std::move(expected));
  }
  void refuse_clip(const SvgElement& element) {
    refuse(element, "svg.too-large", "the lines of clip paths and of what they clip cross too often",
           "a simpler clip path");
  }
  void leave_out(const char* what, const SvgElement& element) {
    LeftOut& left_out = left_out_[what];
    if (++left_out.count == 1) left_out.line = element.line;
  }

  struct LeftOut {
    std::size_t count = 0;
    std::uint32_t line = 0;  // of the first one
  };

  struct UsedClip {
    std::uint32_t path = 0;  // the element <clipPath>
    DxfTransform transform = {};
    std::shared_ptr<const SvgClip> outer = nullptr;
    std::shared_ptr<const SvgClip> clip = nullptr;
  };

  const SvgDocument& document_;
  const SvgOptions& options_;
  Diagnostics& diagnostics_;
  DrawingBuilder builder_;
  double inch_;
  SvgFigureReader reader_;
  std::map<std::string, LeftOut> left_out_;
  SvgFigure* collected_ = nullptr;  // collects what is drawn in a clip path, or for its bounds; otherwise null
  RegionBudget clip_budget_{3};
  UsedClip last_clip_;
  SvgSelection selection_;
  std::size_t work_ = 0;
};

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
  const std::string_view overflow = element.property("overflow");
  const bool shows_all = is_css_word(overflow, "visible") || is_css_word(overflow, "auto");
  if (!shows_all && port.width > 0 && port.height > 0) {
    clip(area_of_view(port, place.transform), element, place);
  }
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
  if (inch_ != svg_inch) {
    builder_.note(
        fmt::format("Inkscape {} wrote this drawing: a pixel is 1/{:g} inch", document_.inkscape_version, inch_));
  }
  expand_root(document_.elements.front());
  note_what_is_left_out();
  for (const std::string& layer : options_.layers) {
    if (std::ranges::find(builder_.drawing().layers, layer) == builder_.drawing().layers.end()) {
      builder_.note(fmt::format("there is no layer '{}'", layer));
    }
  }
  for (std::string& words : selection_.missing()) builder_.note(std::move(words));
  return builder_.take();
}

void SvgExpansion::note_what_is_left_out() {
  for (const auto& [what, left_out] : left_out_) {
    const std::string line = left_out.line == 0 ? "" : fmt::format(", first in line {}", left_out.line);
    builder_.note(fmt::format("ignored: {} {}{}", left_out.count, what, line));
  }
  if (document_.skipped_rules > 0) {
    builder_.note(fmt::format("ignored: {} style rules with other selectors, for other media or in other files",
                              document_.skipped_rules));
  }
}

void SvgExpansion::expand_root(const SvgElement& root) {
  const double pixel = 25.4 / inch_ * options_.scale;
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
    builder_.note(fmt::format(
        "the drawing has no size: its unit is read as a pixel (1/{:g} inch), and its zero is X0 Y0", inch_));
  }
  Place place;
  place.transform = {.xx = pixel, .yy = -pixel, .dy = has_page ? pixel * page.height : 0};
  place.view = page;
  place.layer = builder_.layer("");
  place.is_chosen = options_.layers.empty();
  // The size of the page is that of the view box where the root says none.
  if (box[2] > 0 && box[3] > 0) {
    place.transform = place.transform.after(into_viewport(box, page, root.attribute("preserveAspectRatio")));
    place.view = {box[2], box[3]};
  }
  selection_.enter(root, place.paint);
  if (!is_displayed(root, place) || !transform(root, place)) return;
  clip(0, place);
  add_children(root, place);
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

// Whether the element and its children may be visible.
bool SvgExpansion::is_displayed(const SvgElement& element, Place& place) {
  if (is_css_word(element.property("display"), "none")) {
    leave_out("elements that are not displayed", element);
    return false;
  }
  // Children of a hidden element may be visible.
  const std::string_view visibility = element.property("visibility");
  if (is_css_word(visibility, "hidden") || is_css_word(visibility, "collapse")) {
    place.is_visible = false;
  } else if (is_css_word(visibility, "visible") || is_css_word(visibility, "initial")) {
    place.is_visible = true;
  }
  return true;
}

bool SvgExpansion::transform(const SvgElement& element, Place& place) {
  const std::string_view text = element.property("transform");
  if (text.empty()) return true;
  const std::optional<DxfTransform> own = svg_transform(text);
  if (!own) {
    refuse(element, "svg.transform", fmt::format("'{}' is not a valid transform", text.substr(0, 60)),
           "matrix, translate, scale, rotate, skewX or skewY, with their numbers");
    return false;
  }
  const std::string_view origin = element.property("transform-origin");
  const std::string_view box = element.property("transform-box");
  std::optional<std::array<double, 2>> about = {{0, 0}};
  if (!origin.empty()) about = svg_transform_origin(origin, place.view.width, place.view.height, inch_);
  if (!about || !(box.empty() || is_css_word(box, "view-box"))) {
    leave_out("origins of transforms", element);
    about = {{0, 0}};
  }
  const auto [x, y] = *about;
  place.transform = place.transform.after({.dx = x, .dy = y}).after(*own).after({.dx = -x, .dy = -y});
  return true;
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
  Place place = outer;
  selection_.enter(element, place.paint);
  if (!is_displayed(element, place) || !transform(element, place)) return;
  clip(index, place);
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
  if (used.name == "symbol" || used.name == "svg") {
    if (!is_displayed(used, place) || !transform(used, place)) return;
    clip(found->second, place);
    if (into_svg(used, element, place)) add_children(used, place);
  } else {
    add(found->second, place);
  }
}

void SvgExpansion::draw(const SvgElement& element, const Place& place) {
  // Clip paths are read whole.
  if (!place.is_chosen || (collected_ == nullptr && !selection_.takes(place.paint))) return;
  const std::string& name = element.name;
  const bool is_text = name == "text" || name == "flowRoot";
  const bool is_picture = name == "image" || name == "foreignObject";
  const bool is_shape = SvgFigureReader::is_shape(name);
  if (!place.is_visible && (is_text || is_picture || is_shape)) {
    leave_out("elements that are not displayed", element);
  } else if (is_text) {
    leave_out("texts (convert them to paths)", element);
  } else if (is_picture) {
    leave_out("pictures and foreign objects", element);
  } else if (is_shape) {
    for (const char* const end : {"marker", "marker-start", "marker-mid", "marker-end"}) {
      const std::string_view marker = element.property(end);
      if (!marker.empty() && !is_css_word(marker, "none")) leave_out("markers of lines", element);
    }
    SvgFigure figure;
    reader_.read(element, options_.tells_shapes ? told(place, place.paint, builder_) : SvgSpace(place), figure);
    put(std::move(figure), element, place);
  }
}

// Adds the visible part of the figure to the drawing, or to the figure that is being collected.
void SvgExpansion::put(SvgFigure figure, const SvgElement& element, const Place& place) {
  if (figure.paths.empty() && figure.holes.empty()) return;
  if (place.clip) {
    const std::size_t points_before = figure.holes.size();
    ClippedFigure inside = clipped(std::move(figure), *place.clip, clip_budget_);
    if (!inside.is_affordable) {
      refuse_clip(element);
      return;
    }
    figure = std::move(inside.figure);
    std::size_t points = figure.holes.size();
    for (const DrawnPath& path : figure.paths) points += path.points.size();
    if (points == 0) leave_out("elements outside of their clip path", element);
    if (points > points_before && !builder_.has_room_for(points, SvgFigureReader::place_of(element), "")) return;
  }
  for (DrawnPath& path : figure.paths) {
    if (collected_ != nullptr) {
      collected_->paths.push_back(std::move(path));
    } else {
      builder_.add_path(std::move(path));
    }
  }
  for (const DrawnHole& hole : figure.holes) {
    if (collected_ != nullptr) {
      collected_->holes.push_back(hole);
    } else {
      builder_.add_hole(hole);
    }
  }
}

// Restricts the drawn area to the clip path of the element.
void SvgExpansion::clip(std::uint32_t index, Place& place) {
  const SvgElement& element = document_.elements[index];
  const std::string_view mask = element.property("mask");
  if (!mask.empty() && !is_css_word(mask, "none")) leave_out("masks: what they hide is drawn", element);
  const std::string_view value = element.property("clip-path");
  if (value.empty() || is_css_word(value, "none")) return;
  const std::optional<std::string> id = svg_link(value);
  const auto found = id ? document_.ids.find(*id) : document_.ids.end();
  if (found == document_.ids.end() || document_.elements[found->second].name != "clipPath") {
    leave_out(id ? "clip paths that the drawing does not have" : "clip paths by CSS shapes: what they hide is drawn",
              element);
    return;
  }
  if (place.uses >= deepest_svg_use) {
    refuse(element, "svg.nested-too-deep", fmt::format("clip paths are nested more than {} deep", deepest_svg_use),
           "clip paths that do not contain themselves");
    return;
  }
  // Some programs clip each element with the same path, so the last clip is kept.
  const SvgElement& clip_path = document_.elements[found->second];
  const bool depends_on_place_only = clip_path.attribute("clipPathUnits") != "objectBoundingBox";
  if (depends_on_place_only && last_clip_.clip && last_clip_.path == found->second &&
      last_clip_.transform == place.transform && last_clip_.outer == place.clip) {
    place.clip = last_clip_.clip;
    return;
  }
  const std::shared_ptr<const SvgClip> outer = place.clip;
  const std::optional<Region> area = clip_area(element, clip_path, place);
  if (!area) return;
  clip(*area, element, place);
  if (depends_on_place_only) last_clip_ = {found->second, place.transform, outer, place.clip};
}

void SvgExpansion::clip(const Region& area, const SvgElement& element, Place& place) {
  std::shared_ptr<const SvgClip> clip = clip_within(area, place.clip, clip_budget_);
  if (clip == nullptr) {
    refuse_clip(element);
    return;
  }
  place.clip = std::move(clip);
}

// The area of the clip path for this element. Empty: it cannot be determined.
std::optional<Region> SvgExpansion::clip_area(const SvgElement& element, const SvgElement& clip_path,
                                              const Place& place) {
  Place inside = place;
  inside.is_chosen = inside.is_visible = true;
  inside.clip = nullptr;
  ++inside.uses;
  if (clip_path.attribute("clipPathUnits") == "objectBoundingBox") {
    const std::optional<DrawnBox> box = box_of_content(element, place);
    if (!box) return Region{};
    const auto mm = [](Nanometres length) { return to_mm(length).value(); };
    inside.transform = inside.transform.after({.xx = mm(box->most.x - box->least.x),
                                               .yy = mm(box->most.y - box->least.y),
                                               .dx = mm(box->least.x),
                                               .dy = mm(box->least.y)});
    inside.view = {1, 1};
  }
  if (!transform(clip_path, inside)) return std::nullopt;
  clip(static_cast<std::uint32_t>(&clip_path - document_.elements.data()), inside);
  std::vector<Region> areas;
  SvgFigure* const outer = collected_;
  for (const std::uint32_t child : clip_path.children) {
    SvgFigure figure;
    collected_ = &figure;
    add(child, inside);
    const SvgElement& drawn = document_.elements[child];
    std::string_view rule = drawn.property("clip-rule");
    if (rule.empty()) rule = clip_path.property("clip-rule");
    std::optional<Region> area =
        area_of(figure, is_css_word(rule, "evenodd") ? FillRule::even_odd : FillRule::nonzero, clip_budget_);
    if (!area) {
      refuse_clip(drawn);
      break;
    }
    areas.push_back(std::move(*area));
  }
  collected_ = outer;
  if (areas.size() == 1) return std::move(areas.front());
  if (!clip_budget_.affords(areas)) {
    refuse_clip(clip_path);
    return std::nullopt;
  }
  return united(areas);
}

// The bounding box of the element in its own coordinates: a pixel is a millimetre here.
std::optional<DrawnBox> SvgExpansion::box_of_content(const SvgElement& element, const Place& place) {
  Place own = place;
  own.transform = {};
  own.is_chosen = own.is_visible = true;
  own.clip = nullptr;
  ++own.uses;
  SvgFigure figure;
  SvgFigure* const outer = collected_;
  collected_ = &figure;
  if (element.name == "use") {
    add_use(element, own);
  } else if (SvgFigureReader::is_shape(element.name)) {
    reader_.read(element, own, figure);
  } else {
    add_children(element, own);
  }
  collected_ = outer;
  return bounds(Region{rings_of(figure)});
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
