// PhasePeaks: the speed of the tool against the programmed feed.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "axis_ramp.hpp"
#include "phase_peaks.hpp"

namespace passo::proof {

void PhasePeaks::see_feed(const Segment& segment, const Phase& phase) {
  const double speed = segment.speed.value();
  if (!std::isfinite(speed)) return;
  const double duration = phase.duration.value();
  const double turn = phase.jerk.value() != 0 ? -phase.acceleration.value() / phase.jerk.value() : 0;
  for (const double t : {0.0, std::clamp(turn, 0.0, duration), duration}) {
    const double v = way_at(phase, t).v;
    if (!(v * proof_.feed.limit > proof_.feed.value * speed) && proof_.feed.limit > 0) continue;
    proof_.feed = {.value = v, .limit = speed, .time = now_ + Seconds(t), .line = line_};
  }
}

// A rapid has no feed, and a thread its pitch along the linear axes.
bool PhasePeaks::counts_surface(const Segment& segment, const ExactCurve& curve) const {
  if (!std::isfinite(segment.speed.value()) || segment.lock != SpindleLock::none || segment.takes_up_backlash) {
    return false;
  }
  return std::ranges::any_of(letters_,
                             [&](Axis axis) { return surface_radius_[axis].has_value() && curve.moves(axis); });
}

// The speed of the tool on the surface of the cylinders, from the derivatives of the curve and the radii. The parameter
// of the curve is not used as a length.
void PhasePeaks::see_surface_feed(const Segment& segment, const ExactCurve& curve, const Phase& phase, double speed) {
  constexpr double radians = std::numbers::pi / 180;
  PerAxis<double> unit;  // mm for each mm or degree of the axis; 0: it does not count
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) unit[axis] = 1;
  for (const Axis axis : {Axis::a, Axis::b, Axis::c}) {
    const std::optional<double>& radius = surface_radius_[axis];
    if (radius) unit[axis] = *radius > 0 ? *radius * radians : segment.surface[axis];
  }
  const double duration = phase.duration.value();
  const double turn = phase.jerk.value() != 0 ? -phase.acceleration.value() / phase.jerk.value() : 0;
  for (const double t : {0.0, std::clamp(turn, 0.0, duration), duration / 2, duration}) {
    const Way way = way_at(phase, t);
    const ExactCurve::AllDerivatives slopes = curve.at(all_axes, way.s);
    double squares = 0;
    for (std::size_t i = 0; i < axis_count; ++i) squares += squared(slopes[i].first * unit.values[i]);
    const double v = std::sqrt(squares) * way.v;
    if (!(v * proof_.feed.limit > proof_.feed.value * speed) && proof_.feed.limit > 0) continue;
    proof_.feed = {.value = v, .limit = speed, .time = now_ + Seconds(t), .line = line_};
  }
}

}  // namespace passo::proof
