// Circles, arcs, ellipses and splines.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "curve_chords.hpp"
#include "dxf_expansion.hpp"

#include "passo/geometry/chords.hpp"
#include "passo/geometry/ellipse.hpp"
#include "passo/geometry/nurbs.hpp"

namespace passo {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

}  // namespace

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
  std::vector<DxfPoint> points;
  for (int i = 0; i <= parts; ++i) {
    const double angle = start + sweep * i / parts;
    points.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle), i == parts ? 0 : bulge});
  }
  add_points(entity, points, false, 0, transform, layer);
}

// An arc that is stretched in one direction becomes an arc of an ellipse. Adds the points between its ends.
void DxfExpansion::add_arc_chords(const DxfEntity& entity, const DxfPoint& from, const DxfPoint& to,
                                  const DxfTransform& transform, DrawnPath& path) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const double off = (1 - from.bulge * from.bulge) / (4 * from.bulge);
  const double cx = dx / 2 - dy * off;  // from the start to the centre
  const double cy = dy / 2 + dx * off;
  const double sweep = 4 * std::atan(from.bulge);
  const double radius = std::hypot(cx, cy) * transform.largest_scale();
  const double share = std::clamp(options_.tolerance.value() / std::max(radius, 1e-9), 1e-9, 0.5);
  const double parts = std::ceil(std::abs(sweep) / (2 * std::acos(1 - share)));
  if (!(parts > 1) || !has_room(entity, static_cast<std::size_t>(parts))) return;
  for (double i = 1; i < parts; ++i) {
    const double c = std::cos(sweep * i / parts);
    const double s = std::sin(sweep * i / parts);
    const auto at = point(entity, from.x + cx - c * cx + s * cy, from.y + cy - s * cx - c * cy, transform);
    if (!at) return;
    path.points.push_back({*at});
  }
}

// Cuts the curve into chords. `mm`: an upper bound of the curve's unit, in millimetres.
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
  if (path.points.size() > 2 && path.points.front().at == path.points.back().at) {
    path.is_closed = true;
    path.points.pop_back();  // the start again
  }
  builder_.add_path(std::move(path));
}

void DxfExpansion::add_ellipse(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer) {
  const auto value = [&](int code, double otherwise) { return document_.number(entity, code, otherwise); };
  const Vector3 major{value(11, 1), value(21, 0), value(31, 0)};
  const double ratio = std::abs(value(40, 1));
  const Vector3 minor = minor_axis(normal_of(entity), major, ratio);
  const double start = value(41, 0);
  double sweep = std::fmod(value(42, full_turn) - start, full_turn);
  if (sweep <= 1e-9) sweep += full_turn;
  const bool is_whole = sweep > full_turn - 1e-9;
  const double radius = std::hypot(major.x, major.y);
  const bool is_flat = major.z == 0 && minor.z == 0;
  if (is_whole && is_flat && std::abs(ratio - 1) < 1e-6 && transform.uniform_scale() != 0) {  // a circle
    const auto at = point(entity, value(10, 0), value(20, 0), transform);
    const auto diameter = builder_.length(Mm(2 * radius * transform.uniform_scale()), place_of(entity), "");
    if (at && diameter && has_room(entity, 1)) builder_.add_hole({*at, *diameter, layer, entity.line});
    return;
  }
  const auto ellipse = Ellipse::create(
      {.centre = {value(10, 0), value(20, 0), 0}, .major = major, .minor = minor, .start = {start}, .sweep = {sweep}});
  add_curve(entity, ellipse, transform.largest_scale(), is_whole, transform, layer);
}

void DxfExpansion::add_spline(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer) {
  Nurbs::Definition definition{.degree = static_cast<int>(std::clamp(document_.number(entity, 71, 3), 0.0, 100.0))};
  const int flags = static_cast<int>(document_.number(entity, 70, 0));
  FitSpline fit{.is_closed = (flags & 1) != 0};
  constexpr int by_root = 64;  // parametrisation, where the file names it
  constexpr int evenly = 128;
  fit.exponent = (flags & evenly) != 0 ? 0 : (flags & by_root) != 0 ? 0.5 : 1;
  for (const DxfNumber& number : document_.numbers_of(entity)) {
    if (number.code == 40) definition.knots.push_back(number.value);
    if (number.code == 41) definition.weights.push_back(number.value);
    if (number.code == 10) definition.control.push_back({number.value, 0, 0});
    if (number.code == 20 && !definition.control.empty()) definition.control.back().y = number.value;
    if (number.code == 11) fit.points.push_back({.x = number.value});
    if (number.code == 21 && !fit.points.empty()) fit.points.back().y = number.value;
  }
  fit.start = {document_.number(entity, 12, 0), document_.number(entity, 22, 0)};
  fit.end = {document_.number(entity, 13, 0), document_.number(entity, 23, 0)};
  if (definition.control.empty() && fit.points.size() >= 2) {
    add_fit_spline(entity, fit, transform, layer);
    return;
  }
  add_curve(entity, Nurbs::create(std::move(definition)), transform.largest_scale(), false, transform, layer);
}

void DxfExpansion::add_fit_spline(const DxfEntity& entity, const FitSpline& spline, const DxfTransform& transform,
                                  std::uint32_t layer) {
  const std::vector<CubicPiece> pieces = cubics_through(spline);
  if (pieces.empty()) return;
  DrawnPath path{.points = {}, .is_closed = false, .width = {}, .layer = layer, .line = entity.line};
  const auto put = [&](double x, double y) {
    const auto at = point(entity, x, y, transform);
    if (!at || !has_room(entity, 1)) return false;
    path.points.push_back({*at});
    return true;
  };
  bool goes_on = put(pieces.front()[0].x, pieces.front()[0].y);
  const auto put_on = [&](double x, double y) { return goes_on = put(x, y); };
  for (const CubicPiece& piece : pieces) {
    if (!goes_on) return;
    const double scale = transform.largest_scale();
    if (for_chords(std::span<const FitPoint>(piece), scale, options_.tolerance.value(), put_on)) continue;
    refuse(entity, "dxf.bad-curve", "this curve is too large", "curves of at most a few metres");
    return;
  }
  if (path.points.size() > 2 && path.points.front().at == path.points.back().at) {
    path.is_closed = true;
    path.points.pop_back();
  }
  builder_.add_path(std::move(path));
}

}  // namespace passo
