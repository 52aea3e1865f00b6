#include "limited_axis.hpp"

#include <limits>

namespace passo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double limit_or_infinity(double limit) {
  return limit > 0 ? limit : infinity;
}

}  // namespace

std::vector<LimitedAxis> axes_with_limits(const MotionLimits& limits) {
  std::vector<LimitedAxis> axes;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const LimitedAxis axis{.index = i,
                           .velocity = limit_or_infinity(limits.velocity.values[i].value()),
                           .acceleration = limit_or_infinity(limits.acceleration.values[i].value()),
                           .jerk = limit_or_infinity(limits.jerk.values[i].value()),
                           .falling = limits.falling.values[i].empty() ? nullptr : &limits.falling.values[i]};
    if (std::isfinite(axis.velocity) || std::isfinite(axis.acceleration) || std::isfinite(axis.jerk)) {
      axes.push_back(axis);
    }
  }
  return axes;
}

// Where the limit falls, it is the highest of the lines. Each line gives a speed up to which it allows the turn.
double LimitedAxis::turning_cap(double slope, double bend, double share) const {
  const double constant = bend > 0 ? share * acceleration / bend : infinity;
  if (!falls_at(slope * slope * constant)) return constant;
  double most = 0;
  for (const AccelerationCurve::Line& line : falling->lines()) {
    most = std::max(most, share * line.at_rest / (bend + share * line.fall * slope * slope));
  }
  return std::min(most, constant);
}

}  // namespace passo
