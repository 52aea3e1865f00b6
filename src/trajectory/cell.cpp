#include "cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The most that the path turns in a cell, in radians. What is taken off the limits grows with its square: on an arc
// it is about (3/4) turn², on a cubic as much again for the change of its bend.
constexpr double turn_a_cell_of_arc = 0.04;
constexpr double turn_a_cell_of_cubic = 0.025;

// The switch from speeding up to braking is at the end of some cell. At its ends, where an arc is slow, a cell is no
// longer than this part of the way that braking from full speed takes; from there they grow, to this or to a part of
// the arc, whichever is longer.
constexpr double braking_share = 1.0 / 64;
constexpr double length_share = 1.0 / 128;
constexpr double growth = 2;

// Where limits fall with the speed: by what part of the top speed it changes in a cell, at most.
constexpr double speed_share = 1.0 / 64;
constexpr double most_graded = 10'000;  // cells of a segment

// A feed that is below a limit's shoulder by this is planned as if the limit were constant; the override raises it no
// further.
constexpr double room_for_override = 2;

double squared(double value) {
  return value * value;
}

// The largest k for which k·|direction| stays within `limit` on every axis.
template <class Unit>
double largest_multiple(const Point& direction, const PerAxis<Unit>& limit) {
  double k = infinity;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const double part = std::abs(direction.values[i]);
    const double most = limit.values[i].value();
    if (part > 0 && most > 0) k = std::min(k, most / part);
  }
  return k;
}

}  // namespace

void CellCutter::begin(const Segment& segment) {
  segment_ = &segment;
  at_ = 0;
  const Curve& curve = segment.curve;
  const double length = curve.length().value();
  longest_ = shortest_ = length;
  grade_ = 0;
  const Point steepest = curve.steepest();
  const double top = std::min({segment.speed.value(), largest_multiple(steepest, limits_.velocity), fastest});
  const double strength = std::min(largest_multiple(steepest, limits_.acceleration), strongest);
  const double braking = top * top / (2 * strength);
  if (flat_top(steepest) < room_for_override * top) {
    grade_ = std::max(speed_share * std::sqrt(braking), std::sqrt(2 * length) / most_graded);
  }
  if (curve.shape() == Curve::Shape::line) return;
  if (curve.shape() == Curve::Shape::arc) {
    const double by_turn = length * turn_a_cell_of_arc / std::abs(curve.arc_data().sweep);
    longest_ = std::min({length / 2, by_turn, std::max(braking * braking_share, length * length_share)});
    shortest_ = std::clamp(braking * braking_share, longest_ / 64, longest_);
  } else {
    const double turn = length * curve.curvature();
    const double by_turn = length * turn_a_cell_of_cubic / std::max(turn, turn_a_cell_of_cubic);
    const double wanted = std::min(by_turn, std::max(braking * braking_share, length * length_share));
    longest_ = shortest_ = length / std::ceil(length / wanted);
  }
}

bool CellCutter::next(Piece& piece) {
  const double length = segment_->curve.length().value();
  if (!(at_ < length)) return false;
  // Cells grow away from both ends.
  const double near_start = std::max(shortest_, at_ * (growth - 1));
  const double left = length - at_;
  double size = std::min(longest_, near_start);
  if (left <= 2 * shortest_) {
    size = left <= shortest_ * 1.5 ? left : left / 2;
  } else if (size > left / 2 && longest_ > shortest_) {
    size = left / growth;
  }
  if (grade_ > 0) size = graded(size, left);
  double to = at_ + size;
  if (length - to < size * 1e-6) to = length;
  cut(*segment_, at_, to, piece);
  at_ = to;
  return true;
}

// From rest the speed grows with the root of s: so do the cells, and each end of the segment may be a rest. At least
// two: between two rests one would have no speed.
double CellCutter::graded(double size, double left) const {
  const double near_start = grade_ * (grade_ + 2 * std::sqrt(at_));
  const double root = std::sqrt(left);
  const double near_end = root <= 1.5 * grade_ ? left : grade_ * (2 * root - grade_);
  return std::min({size, near_start, near_end, at_ == 0 ? left / 2 : left});
}

// The speed along the path up to which every limit is constant.
double CellCutter::flat_top(const Point& direction) const {
  double top = infinity;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const AccelerationCurve& curve = limits_.falling.values[i];
    const double part = std::abs(direction.values[i]);
    if (!curve.empty() && part > 0) top = std::min(top, std::sqrt(curve.shoulder()) / part);
  }
  return top;
}

// Bounds of the derivatives between two places: of a cubic the third is constant; on an arc each derivative turns the
// one before, so that its size is that of the slope in the plane times the turn a millimetre.
CellCutter::Bend CellCutter::bend_between(const Curve& curve, const Point& slope_in, const Point& slope_out) {
  Bend bend;
  if (curve.shape() == Curve::Shape::line) return bend;
  if (curve.shape() == Curve::Shape::cubic) {
    for (std::size_t i = 0; i < axis_count; ++i) {
      bend.third.values[i] = 6 * std::abs(curve.cubic_data().third.values[i]);
    }
    return bend;
  }
  const Curve::ArcData& arc = curve.arc_data();
  const double turn = std::abs(arc.sweep) / curve.length().value();
  // A growing radius adds to every derivative; three times its share covers the binomial terms.
  const double growing = 3 * std::abs(arc.end_radius - arc.start_radius) / curve.length().value();
  const double around = growing + std::max(std::hypot(slope_in[arc.first], slope_in[arc.second]),
                                           std::hypot(slope_out[arc.first], slope_out[arc.second]));
  bend.third[arc.first] = bend.third[arc.second] = around * turn * turn;
  bend.fourth[arc.first] = bend.fourth[arc.second] = around * turn * turn * turn;
  return bend;
}

// Between the ends the demand f(s) = q' a + q'' v² has f'' = q'''' v² + 5 a q''', since (v²)' = 2a. It leaves the
// larger of its end values by at most h²/8 times the largest |f''|: that much is taken off the limit.
void CellCutter::cut(const Segment& segment, double from, double to, Piece& piece) const {
  const Curve& curve = segment.curve;
  const double h = to - from;
  const Point slope_in = curve.tangent(Mm(from));
  piece.cell = {.start = from,
                .end = to,
                .length = h,
                .feed_squared = squared(segment.speed.value()),
                .heeds = segment.heeds,
                .lock = segment.lock};
  piece.demand_count = 0;
  piece.falling_count = 0;

  const double flat = flat_top(slope_in);
  const double top_in = std::min(largest_multiple(slope_in, limits_.velocity), fastest);
  if (curve.shape() == Curve::Shape::line && !(flat < room_for_override * std::min(top_in, segment.speed.value()))) {
    piece.cell.top_squared = squared(std::min(top_in, flat));
    piece.cell.acceleration = std::min(largest_multiple(slope_in, limits_.acceleration), strongest);
    piece.cell.straight = true;
    return;
  }

  const Point slope_out = curve.tangent(Mm(to));
  const Point bend_in = curve.second_derivative(Mm(from));
  const Point bend_out = curve.second_derivative(Mm(to));
  const Bend bend = bend_between(curve, slope_in, slope_out);
  const double eighth = h * h / 8;

  Point steepest;
  for (std::size_t i = 0; i < axis_count; ++i) {
    steepest.values[i] =
        std::max(std::abs(slope_in.values[i]), std::abs(slope_out.values[i])) + eighth * bend.third.values[i];
  }
  const double top = std::min(largest_multiple(steepest, limits_.velocity), fastest);
  piece.cell.top_squared = top * top;
  Point least_steep;
  for (std::size_t i = 0; i < axis_count; ++i) {
    least_steep.values[i] = std::min(std::abs(slope_in.values[i]), std::abs(slope_out.values[i]));
  }
  // Turning may hide as much again of an axis's acceleration along its slope.
  const double strength =
      std::min({2 * largest_multiple(least_steep, limits_.acceleration), top * top / (2 * h), strongest});

  for (std::size_t i = 0; i < axis_count; ++i) {
    const double limit = limits_.acceleration.values[i].value();
    if (!(limit > 0) || (steepest.values[i] == 0 && bend_in.values[i] == 0 && bend_out.values[i] == 0)) continue;
    const double slack = eighth * (bend.fourth.values[i] * top * top + 5 * strength * bend.third.values[i]);
    const double in = slope_in.values[i] / (2 * h);
    const double out = slope_out.values[i] / (2 * h);
    piece.demands[piece.demand_count++] = {.entry_x = bend_in.values[i] - in,
                                           .entry_y = in,
                                           .exit_x = -out,
                                           .exit_y = bend_out.values[i] + out,
                                           .limit = std::max(limit - slack, limit / 2)};
    const AccelerationCurve& falling = limits_.falling.values[i];
    const double steep = steepest.values[i];
    if (falling.empty() || !(squared(steep * top) > falling.shoulder())) continue;
    // w = q'² v² bends by w'' = 2 (q''² + q' q''') v² + 8 q' q'' a.
    const double second =
        std::max(std::abs(bend_in.values[i]), std::abs(bend_out.values[i])) + h * bend.third.values[i];
    const double bending =
        2 * (second * second + steep * bend.third.values[i]) * top * top + 8 * steep * second * strength;
    piece.falling[piece.falling_count++] = {.curve = &falling,
                                            .demand = static_cast<std::uint32_t>(piece.demand_count - 1),
                                            .entry_weight = squared(slope_in.values[i]),
                                            .exit_weight = squared(slope_out.values[i]),
                                            .slack = slack,
                                            .slack_of_fall = eighth * bending};
  }
}

}  // namespace passo
