#include "jerk_cell.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

constexpr double cells_a_ramp = 10;      // while the acceleration rises from 0 to its limit
constexpr double usual_rise = 0.02;      // seconds
constexpr double cells_a_braking = 128;  // cells in the time that braking takes, at least
// In seconds. A ramp of some microseconds, to a creeping feed where only an axis that stands has a limit of jerk, needs
// no cells: it is over in one step of a motor.
constexpr double shortest_tick = 20e-6;
constexpr double turn_a_cell = 0.1;  // radians
// The cells of a blend that limits the speed, if a moving axis has no jerk limit. This axis may change its acceleration
// from cell to cell, as the curvature rises and falls: with 0.1 radians per cell, programs of tiny legs take up to 7 %
// more time. On reliefs with jerk limits on all axes, such cells would cost 12 % more planning.
constexpr double fewest_of_blend = 8;
constexpr double turn_of_blend = 0.04;
constexpr double most_cells = 20'000;  // in one segment
constexpr double cells_of_cruise = 4;  // about the cells on each side of the middle where the speed is steady
// A fraction of the segment's length. A shorter cell would not lead to a different position, because of the spacing of
// doubles (1e-16).
constexpr double shortest_part = 1e-13;
constexpr double fewest_from_rest = 16;  // cells of a segment that begins or ends at rest

}  // namespace

JerkCutter::Derivatives JerkCutter::derivatives(const Curve& curve, double s) {
  return {
      .first = curve.tangent(Mm(s)), .second = curve.second_derivative(Mm(s)), .third = curve.third_derivative(Mm(s))};
}

void JerkCutter::begin(const Segment& segment, const Cut& cut) {
  segment_ = &segment;
  at_ = from_ = cut.from;
  const Curve& curve = segment.curve;
  length_ = curve.length().value();
  end_ = std::min(length_, cut.to);
  const Point steepest = curve.steepest();
  speed_ = std::min(cut.feed, fastest);
  top_ = speed_;
  acceleration_ = strongest;
  jerk_ = sharpest;
  bool is_mixed = false;
  for (const LimitedAxis& axis : axes_) {
    const double part = axis.row.most_of(steepest);
    if (!(part > 0)) continue;
    top_ = std::min(top_, axis.velocity / part);
    acceleration_ = std::min(acceleration_, axis.acceleration / part);
    jerk_ = std::min(jerk_, axis.jerk / part);
    is_mixed = is_mixed || std::isinf(axis.jerk);
  }
  straight_ = curve.shape() == Curve::Shape::line;
  for (const LimitedAxis& axis : axes_) {
    const double fastest_of_axis = top_ * axis.row.most_of(steepest);
    straight_ = straight_ && !axis.falls_at(fastest_of_axis * fastest_of_axis);
  }
  entry_ = std::min(cut.entry_squared, top_ * top_);
  exit_ = std::min(cut.exit_squared, top_ * top_);
  const double rise = acceleration_ / jerk_;
  // A slow feed is reached before the acceleration is at its limit. Cells need not be finer than the usual ones.
  const double rise_to_top = std::max(std::min(rise, std::sqrt(top_ / jerk_)), std::min(rise, usual_rise));
  tick_ = std::max({rise_to_top / cells_a_ramp, top_ / acceleration_ / cells_a_braking, shortest_tick});
  const double left = end_ - from_;
  longest_ = left;
  const double turn = curve.turning(steepest);
  if (turn > turn_a_cell) longest_ = length_ * turn_a_cell / turn;
  if (is_mixed && limits_speed())
    longest_ = std::min(longest_, length_ / std::max(fewest_of_blend, turn / turn_of_blend));
  reach_ = std::min(left, top_ * (top_ / acceleration_ + rise));
  shortest_ = reach_ / most_cells;
  if (entry_ == 0 || exit_ == 0) {
    longest_ = std::min(longest_, left / fewest_from_rest);
    // The way that two ticks from rest cover.
    const double way = std::min(8.0 / 6 * jerk_ * tick_, 2 * acceleration_) * tick_ * tick_;
    shortest_ = std::max(shortest_, way);
  }
  longest_ = std::max(longest_, length_ * shortest_part);
  shortest_ = std::clamp(shortest_, length_ * shortest_part, longest_);
  here_ = derivatives(curve, from_);
}

// Whether the segment is a blend whose bend allows less than the top speed, judged at its quarters.
bool JerkCutter::limits_speed() const {
  const Curve& curve = segment_->curve;
  if (curve.shape() == Curve::Shape::line || curve.shape() == Curve::Shape::arc) return false;
  const double top_squared = top_ * top_;
  for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Derivatives all = derivatives(curve, part * length_);
    for (const LimitedAxis& axis : axes_) {
      if (std::abs(axis.row.of(all.second)) * top_squared > axis.acceleration) return true;
      if (std::abs(axis.row.of(all.third)) * top_squared * top_ > axis.jerk) return true;
    }
  }
  return false;
}

double JerkCutter::speed_estimate(double s) const {
  const auto from = [this](double squared, double way) {
    const double by_acceleration = std::sqrt(squared + 2 * acceleration_ * way);
    return std::min(by_acceleration, std::sqrt(squared) + std::cbrt(jerk_ * way * way * 4.5));
  };
  return std::min({top_, from(entry_, s - from_), from(exit_, std::max(end_ - s, 0.0))});
}

bool JerkCutter::next(JerkCell& cell, AxisShape* shapes) {
  if (!(at_ < end_)) return false;
  const double left = end_ - at_;
  double size = std::clamp(tick_ * speed_estimate(at_), shortest_, longest_);
  size = std::clamp(tick_ * speed_estimate(at_ + std::min(size, left) / 2), shortest_, longest_);
  // Far from both ends nothing makes the speed change.
  const double inside = std::min(at_ - from_, left) - reach_;
  if (inside > 0) size = std::clamp(inside / cells_of_cruise, size, longest_);
  if (left < 1.5 * size) {
    size = left;
  } else if (left < 2.5 * size) {
    size = left / 2;
  }
  const double to = left - size < 1e-6 * size ? end_ : at_ + size;
  const Derivatives there = derivatives(segment_->curve, to);
  cell = {.start = at_,
          .length = to - at_,
          .top_squared = straight_ ? top_ * top_ : speed_ * speed_,
          .acceleration = acceleration_,
          .jerk = jerk_,
          .straight = straight_,
          .ends_segment = to == length_};
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const AxisRow& row = axes_[k].row;
    shapes[k] = {.slope_in = row.of(here_.first),
                 .slope_out = row.of(there.first),
                 .bend_in = row.of(here_.second),
                 .bend_out = row.of(there.second),
                 .third_in = row.of(here_.third),
                 .third_out = row.of(there.third)};
  }
  here_ = there;
  at_ = to;
  return true;
}

double JerkCutter::joint_cap(const Segment& before, const Segment& after) const {
  const Point in = before.curve.second_derivative(before.curve.length());
  const Point out = after.curve.second_derivative(Mm(0));
  double cap = entry_cap(after);
  for (const LimitedAxis& axis : axes_) {
    const double jump = std::abs(axis.row.of(out) - axis.row.of(in));
    if (jump > 0 && axis.limits_jerk()) cap = std::min(cap, unseen_jump * axis.acceleration / jump);
  }
  return cap;
}

double JerkCutter::entry_cap(const Segment& segment) const {
  const Derivatives all = derivatives(segment.curve, 0);
  double cap = segment.speed.value() * segment.speed.value();
  for (const LimitedAxis& axis : axes_) {
    const double bend = std::abs(axis.row.of(all.second));
    const double third = std::abs(axis.row.of(all.third));
    if (bend > 0) cap = std::min(cap, axis.acceleration / bend);
    if (third > 0) cap = std::min(cap, std::pow(axis.jerk / third, 2.0 / 3));
  }
  return cap;
}

}  // namespace passo
