#include "passo/cam/dxf.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "drawing_builder.hpp"
#include "drawn_scale.hpp"
#include "dxf_document.hpp"
#include "dxf_transform.hpp"
#include "text_lines.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/geometry/chords.hpp"
#include "passo/geometry/ellipse.hpp"
#include "passo/geometry/nurbs.hpp"

namespace passo {
namespace {

constexpr int deepest_block = 32;
constexpr std::size_t most_work = 100'000'000;  // entities and numbers looked at while blocks are expanded
constexpr double full_turn = 2 * std::numbers::pi;

// What a 1 is in millimetres, by the number of $INSUNITS. 0: no unit of length, or none that a board is drawn in.
double mm_of(int insert_units) {
  constexpr std::array<double, 15> units = {0,       25.4,    304.8, 0,    1,    10,   1000, 0,
                                            25.4e-6, 25.4e-3, 914.4, 1e-7, 1e-6, 1e-3, 100};
  return insert_units >= 0 && insert_units < 15 ? units[static_cast<std::size_t>(insert_units)] : 0;
}

bool same_name(std::string_view a, std::string_view b) {
  const auto capital = [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; };
  return std::ranges::equal(a, b, {}, capital, capital);
}

// A point of a path in the units of its block.
struct LocalPoint {
  double x = 0;
  double y = 0;
  double bulge = 0;
};

class DxfExpansion {
 public:
  DxfExpansion(const std::string& name, const DxfDocument& document, const DxfOptions& options,
               Diagnostics& diagnostics)
      : document_(document), options_(options), builder_(name, diagnostics), diagnostics_(diagnostics) {}

  Drawing expand();

 private:
  using Entities = std::vector<DxfEntity>;

  bool choose_layers();
  double choose_unit();
  void add_all(const Entities& entities, const DxfTransform& transform, std::optional<std::uint32_t> layer, int depth);
  void add(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  void add_circle(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  void add_arc(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  void add_lwpolyline(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  std::size_t add_polyline(const Entities& entities, std::size_t index, const DxfTransform& transform,
                           std::uint32_t layer);
  void add_ellipse(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  void add_spline(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  void add_insert(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer, int depth);
  void add_points(const DxfEntity& entity, const std::vector<LocalPoint>& points, bool is_closed, double width,
                  const DxfTransform& transform, std::uint32_t layer);
  template <ParametricCurve C>
  void add_curve(const DxfEntity& entity, const Result<C, CurveError>& curve, double mm, bool is_closed,
                 const DxfTransform& transform, std::uint32_t layer);
  void note_what_is_left_out();

  // Entities that lie in a plane of their own may be seen from behind.
  DxfTransform seen(const DxfEntity& entity, const DxfTransform& transform) const {
    if (document_.number(entity, 230, 1) >= 0) return transform;
    return transform.after({.xx = -1});
  }
  SourceLocation place_of(const DxfEntity& entity) const { return {entity.line, entity.line == 0 ? 0U : 1U, 1}; }
  bool has_room(const DxfEntity& entity, std::size_t points) {
    return builder_.has_room_for(points, place_of(entity), "");
  }
  bool has_work_left(const DxfEntity& entity);
  std::optional<DrawnPoint> point(const DxfEntity& entity, double x, double y, const DxfTransform& transform) {
    return builder_.point(Mm(transform.x(x, y)), Mm(transform.y(x, y)), place_of(entity), "");
  }
  void refuse(const DxfEntity& entity, const char* code, std::string message, std::string expected) {
    diagnostics_.add({.code = code,
                      .file = builder_.drawing().file,
                      .place = place_of(entity),
                      .message = std::move(message),
                      .expected = std::move(expected),
                      .text = ""});
  }

  const DxfDocument& document_;
  const DxfOptions& options_;
  DrawingBuilder builder_;
  Diagnostics& diagnostics_;
  std::vector<bool> is_chosen_;  // of the document's layers
  std::vector<std::uint32_t> open_blocks_;
  std::size_t work_ = 0;
  std::size_t on_layers_off_ = 0;
  std::size_t in_paper_ = 0;
};

Drawing DxfExpansion::expand() {
  if (!choose_layers()) return builder_.take();
  const double unit = choose_unit();
  add_all(document_.entities, {.xx = unit, .yy = unit}, std::nullopt, 0);
  if (!document_.has_end && !diagnostics_.any_error()) {
    builder_.note("the file does not end with EOF, so it may be truncated");
  }
  note_what_is_left_out();
  Drawing drawing = builder_.take();
  if (const std::string words = words_on_scale(drawing); !words.empty()) drawing.notes.push_back(words);
  return drawing;
}

bool DxfExpansion::choose_layers() {
  is_chosen_.assign(document_.layers.size(), false);
  if (options_.layers.empty()) {
    for (std::size_t i = 0; i < is_chosen_.size(); ++i) is_chosen_[i] = document_.layers[i].is_on;
    return true;
  }
  for (const std::string& name : options_.layers) {
    const auto found = std::ranges::find_if(document_.layers, [&](const auto& l) { return same_name(l.name, name); });
    if (found != document_.layers.end()) {
      is_chosen_[static_cast<std::size_t>(found - document_.layers.begin())] = true;
      continue;
    }
    constexpr std::size_t most_names = 12;
    std::string known;
    for (std::size_t i = 0; i < std::min(most_names, document_.layers.size()); ++i) {
      known += (i == 0 ? "" : ", ") + document_.layers[i].name;
    }
    if (document_.layers.size() > most_names) known += ", ...";
    diagnostics_.add({.code = "dxf.no-layer",
                      .file = builder_.drawing().file,
                      .place = {},
                      .message = fmt::format("the drawing has no layer '{}'", name),
                      .expected = known.empty() ? "" : "one of " + known,
                      .text = ""});
  }
  return !diagnostics_.any_error();
}

double DxfExpansion::choose_unit() {
  const double said = mm_of(document_.insert_units.value_or(0));
  if (options_.unit) {
    if (said > 0 && std::abs(said - options_.unit->value()) > 1e-9 * said) {
      builder_.note(fmt::format("the unit of the drawing is {:g} mm; it is read as {:g} mm, as requested", said,
                                options_.unit->value()));
    }
    return options_.unit->value();
  }
  if (said > 0) return said;
  builder_.note("the drawing does not give its unit; mm is assumed");
  return 1;
}

void DxfExpansion::note_what_is_left_out() {
  std::string names;
  for (const auto& [name, count] : document_.left_out) {
    names += fmt::format("{}{} {}", names.empty() ? "" : ", ", count, name);
    if (names.size() > 200) break;
  }
  if (!names.empty()) builder_.note("ignored, because they are neither holes nor lines: " + names);
  if (on_layers_off_ != 0) builder_.note("ignored, on other layers: " + counted(on_layers_off_, "entity", "entities"));
  if (in_paper_ != 0) builder_.note("ignored, in paper space: " + counted(in_paper_, "entity", "entities"));
}

bool DxfExpansion::has_work_left(const DxfEntity& entity) {
  work_ += 1 + entity.count;
  if (work_ <= most_work) return true;
  if (!diagnostics_.any_error()) {
    refuse(entity, "drawing.too-large", "with its nested blocks, the drawing is too large",
           "a drawing with fewer repeats");
  }
  return false;
}

// `layer`: of the INSERT that places these entities. In a block, layer 0 is the layer of the INSERT.
void DxfExpansion::add_all(const Entities& entities, const DxfTransform& transform, std::optional<std::uint32_t> layer,
                           int depth) {
  for (std::size_t i = 0; i < entities.size() && !builder_.is_full() && !diagnostics_.full(); ++i) {
    const DxfEntity& entity = entities[i];
    if (!has_work_left(entity)) return;
    if (entity.is_in_paper) {
      ++in_paper_;
      continue;
    }
    std::uint32_t own = entity.layer;
    if (layer && document_.layers[own].name == "0") own = *layer;
    if (entity.kind == DxfKind::insert) {
      add_insert(entity, transform, own, depth);
      continue;
    }
    const bool is_part = entity.kind == DxfKind::vertex || entity.kind == DxfKind::seqend;
    if (is_part) continue;
    if (!is_chosen_[own]) {
      ++on_layers_off_;
      continue;
    }
    const std::uint32_t drawn = builder_.layer(document_.layers[own].name);
    if (entity.kind == DxfKind::polyline) {
      i = add_polyline(entities, i, transform, drawn);
    } else {
      add(entity, transform, drawn);
    }
  }
}

void DxfExpansion::add(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer) {
  const auto value = [&](int code) { return document_.number(entity, code, 0); };
  switch (entity.kind) {
    case DxfKind::point:
      if (const auto at = point(entity, value(10), value(20), transform); at && has_room(entity, 1)) {
        builder_.add_hole({*at, {}, layer, entity.line});
      }
      return;
    case DxfKind::line:
      add_points(entity, {{value(10), value(20)}, {value(11), value(21)}}, false, 0, transform, layer);
      return;
    case DxfKind::circle: add_circle(entity, seen(entity, transform), layer); return;
    case DxfKind::arc: add_arc(entity, seen(entity, transform), layer); return;
    case DxfKind::lwpolyline: add_lwpolyline(entity, seen(entity, transform), layer); return;
    case DxfKind::ellipse: add_ellipse(entity, transform, layer); return;
    case DxfKind::spline: add_spline(entity, transform, layer); return;
    default: return;
  }
}

void DxfExpansion::add_circle(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer) {
  const double x = document_.number(entity, 10, 0);
  const double y = document_.number(entity, 20, 0);
  const double radius = std::abs(document_.number(entity, 40, 0));
  const double scale = transform.uniform_scale();
  if (scale == 0) {
    const auto ellipse = Ellipse::flat({x, y, 0}, Mm(radius), Mm(radius), {0}, {0}, {full_turn});
    add_curve(entity, ellipse, transform.largest_scale(), true, transform, layer);
    return;
  }
  const auto at = point(entity, x, y, transform);
  const auto diameter = builder_.length(Mm(2 * radius * scale), place_of(entity), "");
  if (at && diameter && has_room(entity, 1)) builder_.add_hole({*at, *diameter, layer, entity.line});
}

void DxfExpansion::add_arc(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer) {
  const double x = document_.number(entity, 10, 0);
  const double y = document_.number(entity, 20, 0);
  const double radius = std::abs(document_.number(entity, 40, 0));
  const double start = document_.number(entity, 50, 0) * std::numbers::pi / 180;
  double sweep = std::fmod(document_.number(entity, 51, 360) * std::numbers::pi / 180 - start, full_turn);
  if (sweep <= 1e-12) sweep += full_turn;
  if (transform.uniform_scale() == 0) {
    const auto ellipse = Ellipse::flat({x, y, 0}, Mm(radius), Mm(radius), {0}, {start}, {sweep});
    add_curve(entity, ellipse, transform.largest_scale(), false, transform, layer);
    return;
  }
  const int parts = sweep > std::numbers::pi ? 2 : 1;  // an arc of more than a half circle has a large bulge
  const double bulge = std::tan(sweep / parts / 4);
  std::vector<LocalPoint> points;
  for (int i = 0; i <= parts; ++i) {
    const double angle = start + sweep * i / parts;
    points.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle), i == parts ? 0 : bulge});
  }
  add_points(entity, points, false, 0, transform, layer);
}

void DxfExpansion::add_lwpolyline(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer) {
  std::vector<LocalPoint> points;
  for (const DxfNumber& number : document_.numbers_of(entity)) {
    if (number.code == 10) points.push_back({.x = number.value});
    if (points.empty()) continue;
    if (number.code == 20) points.back().y = number.value;
    if (number.code == 42) points.back().bulge = number.value;
  }
  const bool is_closed = (static_cast<int>(document_.number(entity, 70, 0)) & 1) != 0;
  const double width = document_.number(entity, 43, document_.number(entity, 40, 0));
  add_points(entity, points, is_closed, width, transform, layer);
}

// Returns the index of the last entity that belongs to the polyline.
std::size_t DxfExpansion::add_polyline(const Entities& entities, std::size_t index, const DxfTransform& transform,
                                       std::uint32_t layer) {
  const DxfEntity& head = entities[index];
  const int flags = static_cast<int>(document_.number(head, 70, 0));
  constexpr int mesh = 16 | 64;
  std::vector<LocalPoint> points;
  std::size_t last = index;
  while (last + 1 < entities.size() && entities[last + 1].kind == DxfKind::vertex) {
    const DxfEntity& vertex = entities[++last];
    if (!has_work_left(vertex)) return last;
    constexpr int frame_of_spline = 16;
    if ((static_cast<int>(document_.number(vertex, 70, 0)) & frame_of_spline) != 0) continue;
    points.push_back(
        {document_.number(vertex, 10, 0), document_.number(vertex, 20, 0), document_.number(vertex, 42, 0)});
  }
  if ((flags & mesh) == 0) {
    add_points(head, points, (flags & 1) != 0, document_.number(head, 40, 0), seen(head, transform), layer);
  }
  return last;
}

// A closed path of two half circles is a circle. A DONUT is one with a width: its hole is the inner circle.
std::optional<double> radius_of_circle(const std::vector<LocalPoint>& points, bool is_closed) {
  if (!is_closed || points.size() != 2) return std::nullopt;
  const double a = points[0].bulge;
  if (std::abs(std::abs(a) - 1) > 1e-6 || std::abs(a - points[1].bulge) > 1e-6) return std::nullopt;
  return std::hypot(points[1].x - points[0].x, points[1].y - points[0].y) / 2;
}

void DxfExpansion::add_points(const DxfEntity& entity, const std::vector<LocalPoint>& points, bool is_closed,
                              double width, const DxfTransform& transform, std::uint32_t layer) {
  const double scale = transform.uniform_scale();
  if (const auto radius = radius_of_circle(points, is_closed); radius && scale != 0) {
    const double inner = std::max(0.0, *radius - std::abs(width) / 2);
    const auto at = point(entity, (points[0].x + points[1].x) / 2, (points[0].y + points[1].y) / 2, transform);
    const auto diameter = builder_.length(Mm(2 * inner * scale), place_of(entity), "");
    if (at && diameter && has_room(entity, 1)) builder_.add_hole({*at, *diameter, layer, entity.line});
    return;
  }
  if (points.size() < 2 || !has_room(entity, points.size())) return;
  DrawnPath path{.points = {}, .is_closed = is_closed, .width = {}, .layer = layer, .line = entity.line};
  bool has_bent = false;
  for (const LocalPoint& local : points) {
    const auto at = point(entity, local.x, local.y, transform);
    if (!at) return;
    double bulge = transform.is_mirrored() ? -local.bulge : local.bulge;
    if (!std::isfinite(bulge) || std::abs(bulge) < 1e-9) bulge = 0;
    if (scale == 0 && bulge != 0) {
      bulge = 0;
      has_bent = true;
    }
    path.points.push_back({*at, bulge});
  }
  if (has_bent) {
    builder_.note(
        fmt::format("line {}: the arcs of a path scaled in one direction only are read as lines", entity.line));
  }
  builder_.add_path(std::move(path));
}

// Cuts the curve into chords. `mm`: an upper bound of the millimetres that a 1 of the curve is.
template <ParametricCurve C>
void DxfExpansion::add_curve(const DxfEntity& entity, const Result<C, CurveError>& curve, double mm, bool is_closed,
                             const DxfTransform& transform, std::uint32_t layer) {
  if (!curve) {
    refuse(entity, "dxf.bad-curve", "this curve cannot be drawn: " + curve.error().message, "");
    return;
  }
  const double local = mm > 0 ? options_.tolerance.value() / mm : 1;
  const auto tolerance = ChordTolerance::of(std::max(Mm(local), ChordTolerance::least));
  Chords chords(*curve, *tolerance);
  DrawnPath path{.points = {}, .is_closed = is_closed, .width = {}, .layer = layer, .line = entity.line};
  const Vector3 start = curve->at(curve->range().low);
  const auto first = point(entity, start.x, start.y, transform);
  if (!first || !has_room(entity, 1)) return;
  path.points.push_back({*first});
  for (Chord chord; chords.next(chord);) {
    const auto at = point(entity, chord.end.x, chord.end.y, transform);
    if (!at || !has_room(entity, 1)) return;
    path.points.push_back({*at});
  }
  if (is_closed && path.points.size() > 2) path.points.pop_back();  // the start again
  builder_.add_path(std::move(path));
}

void DxfExpansion::add_ellipse(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer) {
  const auto value = [&](int code, double otherwise) { return document_.number(entity, code, otherwise); };
  const Vector3 major{value(11, 1), value(21, 0), 0};
  const double ratio = std::abs(value(40, 1));
  const double sense = value(230, 1) < 0 ? -1 : 1;
  const double start = value(41, 0);
  double sweep = std::fmod(value(42, full_turn) - start, full_turn);
  if (sweep <= 1e-9) sweep += full_turn;
  const bool is_whole = sweep > full_turn - 1e-9;
  const double radius = std::hypot(major.x, major.y);
  if (is_whole && std::abs(ratio - 1) < 1e-6 && transform.uniform_scale() != 0) {  // a circle
    const auto at = point(entity, value(10, 0), value(20, 0), transform);
    const auto diameter = builder_.length(Mm(2 * radius * transform.uniform_scale()), place_of(entity), "");
    if (at && diameter && has_room(entity, 1)) builder_.add_hole({*at, *diameter, layer, entity.line});
    return;
  }
  const auto ellipse = Ellipse::create({.centre = {value(10, 0), value(20, 0), 0},
                                        .major = major,
                                        .minor = {-major.y * ratio * sense, major.x * ratio * sense, 0},
                                        .start = {start},
                                        .sweep = {sweep}});
  add_curve(entity, ellipse, transform.largest_scale(), is_whole, transform, layer);
}

void DxfExpansion::add_spline(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer) {
  Nurbs::Definition definition{.degree = static_cast<int>(std::clamp(document_.number(entity, 71, 3), 0.0, 100.0))};
  std::vector<LocalPoint> fit;
  for (const DxfNumber& number : document_.numbers_of(entity)) {
    if (number.code == 40) definition.knots.push_back(number.value);
    if (number.code == 41) definition.weights.push_back(number.value);
    if (number.code == 10) definition.control.push_back({number.value, 0, 0});
    if (number.code == 20 && !definition.control.empty()) definition.control.back().y = number.value;
    if (number.code == 11) fit.push_back({.x = number.value});
    if (number.code == 21 && !fit.empty()) fit.back().y = number.value;
  }
  const bool is_closed = (static_cast<int>(document_.number(entity, 70, 0)) & 1) != 0;
  if (definition.control.empty() && fit.size() >= 2) {
    builder_.note(
        fmt::format("line {}: a spline without control points is read as lines between its fit points", entity.line));
    add_points(entity, fit, is_closed, 0, transform, layer);
    return;
  }
  add_curve(entity, Nurbs::create(std::move(definition)), transform.largest_scale(), false, transform, layer);
}

void DxfExpansion::add_insert(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer, int depth) {
  const auto value = [&](int code, double otherwise) { return document_.number(entity, code, otherwise); };
  if (document_.blocks.size() <= entity.block || !document_.blocks[entity.block].is_defined) {
    refuse(entity, "dxf.no-block", "this INSERT names a block that the drawing does not have",
           "a block in the section BLOCKS");
    return;
  }
  if (depth >= deepest_block || std::ranges::find(open_blocks_, entity.block) != open_blocks_.end()) {
    refuse(entity, "dxf.nested-too-deep",
           fmt::format("the block '{}' contains itself, or is nested more than {} deep",
                       document_.blocks[entity.block].name, deepest_block),
           "blocks that do not contain themselves");
    return;
  }
  const DxfBlock& block = document_.blocks[entity.block];
  const double angle = value(50, 0) * std::numbers::pi / 180;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double scale_x = value(41, 1);
  const double scale_y = value(42, 1);
  const auto copies = [&](int code) { return static_cast<std::int64_t>(std::clamp(value(code, 1), 1.0, 32767.0)); };
  open_blocks_.push_back(entity.block);
  const DxfTransform outer = seen(entity, transform);
  for (std::int64_t row = 0; row < copies(71); ++row) {
    for (std::int64_t column = 0; column < copies(70); ++column) {
      if (builder_.is_full() || diagnostics_.full() || !has_work_left(entity)) break;
      const double along = static_cast<double>(column) * value(44, 0);
      const double up = static_cast<double>(row) * value(45, 0);
      // The block's base point comes to the insertion point, after scaling and turning.
      const DxfTransform placed{c * scale_x,
                                -s * scale_y,
                                s * scale_x,
                                c * scale_y,
                                value(10, 0) + c * along - s * up,
                                value(20, 0) + s * along + c * up};
      const DxfTransform from_base{.dx = -block.base_x, .dy = -block.base_y};
      add_all(block.entities, outer.after(placed).after(from_base), layer, depth + 1);
    }
  }
  open_blocks_.pop_back();
}

}  // namespace

Drawing read_dxf(const std::string& name, std::string_view text, const DxfOptions& options, Diagnostics& diagnostics) {
  const DxfDocument document = read_dxf_document(name, text, diagnostics);
  if (diagnostics.any_error()) {
    Drawing nothing;
    nothing.file = name;
    return nothing;
  }
  return DxfExpansion(name, document, options, diagnostics).expand();
}

bool looks_like_dxf(std::string_view text) {
  if (text.starts_with("AutoCAD Binary DXF")) return true;
  TextLines lines(text);
  std::string_view code;
  std::string_view value;
  for (int i = 0; i < 50 && lines.next(code) && lines.next(value); ++i) {
    code = trimmed(code);
    if (code == "0" && trimmed(value) == "SECTION") return true;
    if (code != "999") return false;
  }
  return false;
}

}  // namespace passo
