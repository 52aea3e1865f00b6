#include "line_merger.hpp"

#include <algorithm>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// Vertices closer than this (mm) to a line are on it: rounding.
constexpr double rounding = 1e-9;

// A merged line may be shorter than its pieces by this share, so that its time is not less than theirs.
constexpr double least_length = 0.99;

bool are_alike(const Segment& before, const Segment& after) {
  return before.speed == after.speed && before.rapid == after.rapid && before.tolerance == after.tolerance &&
         before.merge == after.merge && before.mode != PathMode::exact_stop && before.work_zero == after.work_zero &&
         before.heeds == after.heeds && before.lock == after.lock && before.pitch == after.pitch;
}

bool is_line(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  return segment != nullptr && segment->curve.shape() == Curve::Shape::line;
}

}  // namespace

void LineMerger::Cone::begin(const Point& direction, double length, double within) {
  tolerance = within;
  center = direction;
  radius = within / length;
}

bool LineMerger::Cone::has(const Point& direction) const {
  return distance(direction, center) <= radius;
}

// Two balls: one in the other, or else the ball between their borders.
void LineMerger::Cone::narrow(const Point& direction, double length) {
  const double allowed = tolerance / length;
  const double apart = distance(direction, center);
  if (apart <= allowed - radius) return;
  if (apart <= radius - allowed) {
    center = direction;
    radius = allowed;
    return;
  }
  center = center + (direction - center) * ((apart + radius - allowed) / (2 * apart));
  radius = (radius + allowed - apart) / 2;
}

bool LineMerger::pull() {
  if (!has_ahead_ && !at_end_) {
    has_ahead_ = path_.next(ahead_);
    at_end_ = !has_ahead_;
  }
  return has_ahead_;
}

bool LineMerger::takes_in(const Segment& line) const {
  if (!are_alike(line_, line)) return false;
  const Point& anchor = line_.curve.start();
  const Point travel = line.curve.end() - anchor;
  const Point own = line.curve.end() - line.curve.start();
  const Point before = line_.curve.end() - anchor;
  if (!(dot(own, before) > 0)) return false;
  if (counted_group(own) != counted_group(before) || counted_group(travel) != counted_group(own)) return false;
  return cone_.has(travel * (1 / length_of(travel)));
}

// Not more than half of what the junction before allows: the rest is for rounding it.
double LineMerger::merge_tolerance() const {
  double tolerance = line_.merge.value();
  if (mode_before_ == PathMode::exact_path) tolerance = 0;
  if (mode_before_ == PathMode::continuous) tolerance = std::min(tolerance, tolerance_before_ / 2);
  return std::max(tolerance, rounding);
}

bool LineMerger::next(PathItem& item, double& deviation) {
  deviation = 0;
  if (!pull()) return false;
  has_ahead_ = false;
  if (!is_line(ahead_)) {
    std::swap(item, ahead_);
    const auto* const segment = std::get_if<Segment>(&item);
    mode_before_ = segment != nullptr ? segment->mode : PathMode::exact_stop;
    tolerance_before_ = segment != nullptr ? segment->tolerance.value() : 0;
    return true;
  }
  line_ = std::get<Segment>(ahead_);
  double programmed = line_.curve.length().value();
  const Point start = line_.curve.start();
  for (int count = 1; count < most_merged && pull() && is_line(ahead_); ++count) {
    const Segment& line = std::get<Segment>(ahead_);
    if (count == 1) {
      const Point travel = line_.curve.end() - start;
      const double length = length_of(travel);
      cone_.begin(travel * (1 / length), length, merge_tolerance());
      exact_.begin(cone_.center, length, rounding);
    }
    if (!takes_in(line)) break;
    const Curve merged = Curve::line(start, line.curve.end());
    programmed += line.curve.length().value();
    if (merged.length().value() < least_length * programmed) break;

    const Point travel = line.curve.end() - start;
    const double length = length_of(travel);
    const Point direction = travel * (1 / length);
    if (!exact_.has(direction)) deviation = cone_.tolerance;
    if (deviation == 0) exact_.narrow(direction, length);
    cone_.narrow(direction, length);
    line_.curve = merged;
    line_.mode = line.mode;
    has_ahead_ = false;
  }
  mode_before_ = line_.mode;
  tolerance_before_ = line_.tolerance.value();
  item = line_;
  return true;
}

}  // namespace passo
