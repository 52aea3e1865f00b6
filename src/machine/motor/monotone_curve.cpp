#include "passo/motor/monotone_curve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

struct Piece {
  double width = 0;
  double slope = 0;  // of the chord from one point to the next
};

Piece piece_between(const CurvePoint& from, const CurvePoint& to) {
  return {.width = to.x - from.x, .slope = (to.y - from.y) / (to.x - from.x)};
}

// The harmonic mean of both chords' slopes, in which the shorter piece counts more. 0 at a peak or valley.
double inner_slope(const Piece& left, const Piece& right) {
  if (!(left.slope * right.slope > 0)) return 0;
  const double left_weight = left.width + 2 * right.width;
  const double right_weight = 2 * left.width + right.width;
  return (left_weight + right_weight) / (left_weight / left.slope + right_weight / right.slope);
}

// The slope of the parabola through the last three points, limited so that the end piece does not turn.
double end_slope(const Piece& end, const Piece& next) {
  const double slope = ((2 * end.width + next.width) * end.slope - end.width * next.slope) / (end.width + next.width);
  if (!(slope * end.slope > 0)) return 0;
  if (!(end.slope * next.slope > 0) && std::abs(slope) > 3 * std::abs(end.slope)) return 3 * end.slope;
  return slope;
}

}  // namespace

Result<MonotoneCurve, CurvePointsError> MonotoneCurve::through(std::vector<CurvePoint> points) {
  if (points.size() < 2) {
    return Failure{CurvePointsError{fmt::format("a curve needs at least 2 points, not {}", points.size())}};
  }
  for (const CurvePoint& point : points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      return Failure{CurvePointsError{fmt::format("{:g}:{:g} is not a valid point of a curve", point.x, point.y)}};
    }
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].x > points[i - 1].x) continue;
    return Failure{CurvePointsError{
        fmt::format("the points must be in ascending order, but {:g} follows {:g}", points[i].x, points[i - 1].x)}};
  }
  return MonotoneCurve(std::move(points));
}

MonotoneCurve::MonotoneCurve(std::vector<CurvePoint> points) : points_(std::move(points)), slopes_(points_.size()) {
  std::vector<Piece> pieces;
  for (std::size_t i = 1; i < points_.size(); ++i) pieces.push_back(piece_between(points_[i - 1], points_[i]));
  if (pieces.size() == 1) {
    slopes_ = {pieces[0].slope, pieces[0].slope};
    return;
  }
  const std::size_t last = pieces.size() - 1;
  slopes_.front() = end_slope(pieces[0], pieces[1]);
  slopes_.back() = end_slope(pieces[last], pieces[last - 1]);
  for (std::size_t i = 1; i <= last; ++i) slopes_[i] = inner_slope(pieces[i - 1], pieces[i]);
}

double MonotoneCurve::at(double x) const {
  if (!(x > first())) return points_.front().y;
  if (!(x < last())) return points_.back().y;
  const auto right = std::upper_bound(points_.begin(), points_.end(), x,
                                      [](double value, const CurvePoint& point) { return value < point.x; });
  const auto i = static_cast<std::size_t>(right - points_.begin()) - 1;
  const CurvePoint& from = points_[i];
  const CurvePoint& to = points_[i + 1];
  const double width = to.x - from.x;
  const double t = (x - from.x) / width;
  const double u = 1 - t;
  // In the cubic Bézier form rounding cannot leave the hull of the four values.
  const double second = from.y + slopes_[i] * width / 3;
  const double third = to.y - slopes_[i + 1] * width / 3;
  const double y = u * u * u * from.y + 3 * u * u * t * second + 3 * u * t * t * third + t * t * t * to.y;
  return std::clamp(y, std::min(from.y, to.y), std::max(from.y, to.y));
}

}  // namespace passo
