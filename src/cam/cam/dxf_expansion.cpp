#include "dxf_expansion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "drawn_scale.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

constexpr int deepest_block = 32;
constexpr std::size_t most_work = 100'000'000;  // entities and numbers looked at while blocks are expanded

// The unit of length in millimetres, by the number of $INSUNITS. 0: not a unit of length, or not one for boards.
double mm_of(int insert_units) {
  constexpr std::array<double, 15> units = {0,       25.4,    304.8, 0,    1,    10,   1000, 0,
                                            25.4e-6, 25.4e-3, 914.4, 1e-7, 1e-6, 1e-3, 100};
  return insert_units >= 0 && insert_units < 15 ? units[static_cast<std::size_t>(insert_units)] : 0;
}

bool same_name(std::string_view a, std::string_view b) {
  const auto capital = [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; };
  return std::ranges::equal(a, b, {}, capital, capital);
}

// A closed path of two half circles is a circle. With a width it is a DONUT, whose hole is the inner circle.
std::optional<double> radius_of_circle(const std::vector<DxfPoint>& points, bool is_closed) {
  if (!is_closed || points.size() != 2) return std::nullopt;
  const double a = points[0].bulge;
  if (std::abs(std::abs(a) - 1) > 1e-6 || std::abs(a - points[1].bulge) > 1e-6) return std::nullopt;
  return std::hypot(points[1].x - points[0].x, points[1].y - points[0].y) / 2;
}

}  // namespace

Drawing DxfExpansion::expand() {
  if (!choose_layers()) return builder_.take();
  const double unit = choose_unit();
  add_all(document_.entities, {.xx = unit, .yy = unit}, std::nullopt, 0);
  if (!document_.has_end && !diagnostics_.any_error()) {
    builder_.note("the file does not end with EOF, so it may be truncated");
  }
  note_what_is_left_out();
  for (std::string& words : selection_.missing()) builder_.note(std::move(words));
  Drawing drawing = builder_.take();
  const std::string words = options_.is_for_drilling ? words_on_scale(drawing) : "";
  if (!words.empty()) drawing.notes.push_back(words);
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
      const std::string& other = document_.layers[i].name;
      if (!other.empty()) known += (known.empty() ? "" : ", ") + other;
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
  if (wide_ != 0) {
    builder_.note(fmt::format("{} with a width {} read as {} middle, first in line {}", counted(wide_, "polyline"),
                              wide_ == 1 ? "is" : "are", wide_ == 1 ? "its" : "their", first_wide_));
  }
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

// `layer`: that of the INSERT that places these entities. In a block, layer 0 stands for the layer of the INSERT.
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
    if (!selection_.takes(entity, own, around_)) continue;
    const std::string told = options_.tells_shapes ? selection_.told(entity, own, around_) : "";
    const std::uint32_t drawn = builder_.layer(document_.layers[own].name + told);
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

void DxfExpansion::add_lwpolyline(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer) {
  std::vector<DxfPoint> points;
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
  std::vector<DxfPoint> points;
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

void DxfExpansion::add_points(const DxfEntity& entity, const std::vector<DxfPoint>& points, bool is_closed,
                              double width, const DxfTransform& transform, std::uint32_t layer) {
  const double scale = transform.uniform_scale();
  const auto radius = radius_of_circle(points, is_closed);
  const bool is_donut = options_.is_for_drilling && radius && scale != 0;
  if (std::abs(width) > 0 && !is_donut && wide_++ == 0) first_wide_ = entity.line;
  if (radius && scale != 0) {
    const double drawn = is_donut ? std::max(0.0, *radius - std::abs(width) / 2) : *radius;
    const auto at = point(entity, (points[0].x + points[1].x) / 2, (points[0].y + points[1].y) / 2, transform);
    const auto diameter = builder_.length(Mm(2 * drawn * scale), place_of(entity), "");
    if (at && diameter && has_room(entity, 1)) builder_.add_hole({*at, *diameter, layer, entity.line});
    return;
  }
  if (points.size() < 2 || !has_room(entity, points.size())) return;
  DrawnPath path{.points = {}, .is_closed = is_closed, .width = {}, .layer = layer, .line = entity.line};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const DxfPoint& local = points[i];
    const auto at = point(entity, local.x, local.y, transform);
    if (!at) return;
    double bulge = transform.is_mirrored() ? -local.bulge : local.bulge;
    if (!std::isfinite(bulge) || std::abs(bulge) < 1e-9) bulge = 0;
    path.points.push_back({*at, scale == 0 ? 0 : bulge});
    const bool has_next = i + 1 < points.size() || is_closed;
    if (scale == 0 && bulge != 0 && has_next) {
      add_arc_chords(entity, local, points[(i + 1) % points.size()], transform, path);
    }
  }
  builder_.add_path(std::move(path));
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
  const DxfSelection::Around outside = around_;
  around_ = selection_.inside(entity, layer, outside);
  const DxfTransform outer = seen(entity, transform);
  for (std::int64_t row = 0; row < copies(71); ++row) {
    for (std::int64_t column = 0; column < copies(70); ++column) {
      if (builder_.is_full() || diagnostics_.full() || !has_work_left(entity)) break;
      const double along = static_cast<double>(column) * value(44, 0);
      const double up = static_cast<double>(row) * value(45, 0);
      // After scaling and rotation, the block's base point is moved to the insertion point.
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
  around_ = outside;
}

}  // namespace passo
