#include "passo/trajectory/acceleration_curve.hpp"

#include <algorithm>
#include <cassert>

namespace passo {
namespace {

struct Corner {
  double w = 0;
  double acceleration = 0;
};

// A line of the hull is left out if the kept lines are lower than it by less than this share.
constexpr double share_lost = 2e-4;

// Between two samples a falling function is at least as high as at the second sample. Returns the low corners of these
// stairs, beginning at the last one that is above `most`.
std::vector<Corner> low_corners(std::span<const AccelerationCurve::Sample> samples, double most) {
  std::vector<Corner> corners;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const double speed = samples[i].speed.value();
    const Corner corner{.w = speed * speed, .acceleration = samples[i + 1].acceleration.value()};
    if (corner.acceleration >= most) corners.clear();
    corners.push_back(corner);
  }
  if (!samples.empty()) {
    const double speed = samples.back().speed.value();
    corners.push_back({.w = speed * speed, .acceleration = samples.back().acceleration.value()});
  }
  return corners;
}

bool is_above_chord(const Corner& from, const Corner& middle, const Corner& to) {
  return (middle.acceleration - from.acceleration) * (to.w - from.w) >=
         (to.acceleration - from.acceleration) * (middle.w - from.w);
}

// The lower hull, from left to right (A. M. Andrew's monotone chain).
std::vector<Corner> lower_hull(const std::vector<Corner>& corners) {
  std::vector<Corner> hull;
  for (const Corner& corner : corners) {
    while (hull.size() >= 2 && is_above_chord(hull[hull.size() - 2], hull.back(), corner)) hull.pop_back();
    hull.push_back(corner);
  }
  return hull;
}

AccelerationCurve::Line line_through(const Corner& from, const Corner& to) {
  const double fall = (from.acceleration - to.acceleration) / (to.w - from.w);
  return {.at_rest = from.acceleration + fall * from.w, .fall = fall};
}

}  // namespace

AccelerationCurve AccelerationCurve::below(std::span<const Sample> samples, MmPerSecond2 most) {
  AccelerationCurve curve;
  const std::vector<Corner> hull = lower_hull(low_corners(samples, most.value()));
  if (hull.size() < 2 || hull.back().acceleration >= most.value()) return curve;
  for (std::size_t i = 1; i < hull.size(); ++i) {
    curve.add(line_through(hull[i - 1], hull[i]), hull[i].w);
  }
  const Line& first = curve.lines_.front();
  curve.shoulder_ = first.fall > 0 ? std::max((first.at_rest - most.value()) / first.fall, 0.0) : 0;
  return curve;
}

// Adds a line of the hull, which is the highest one up to w.
void AccelerationCurve::add(const Line& line, double w) {
  if (!lines_.empty()) {
    const Line& before = lines_.back();
    if (before.at(w) > (1 - share_lost) * line.at(w) || !(line.fall < before.fall)) return;
    ends_.push_back((before.at_rest - line.at_rest) / (before.fall - line.fall));
  }
  lines_.push_back(line);
}

std::size_t AccelerationCurve::line_at(double w) const {
  assert(!lines_.empty());
  return static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), w) - ends_.begin());
}

std::span<const double> AccelerationCurve::bends_between(double low, double high) const {
  return std::span(ends_).subspan(line_at(low), line_at(high) - line_at(low));
}

MmPerSecond2 AccelerationCurve::at(MmPerSecond speed) const {
  const double w = speed.value() * speed.value();
  return MmPerSecond2(lines_[line_at(w)].at(w));
}

}  // namespace passo
