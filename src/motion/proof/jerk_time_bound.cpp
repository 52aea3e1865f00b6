#include "jerk_time_bound.hpp"

#include <algorithm>
#include <cmath>

namespace passo::proof {

JerkTimeBound::JerkTimeBound(const std::vector<ProvenAxis>& axes) {
  for (const ProvenAxis& axis : axes) {
    axes_.emplace_back(RampBound(axis.acceleration.value(), axis.jerk.value()), axis.start_stop.value());
    axes_.back().start = axes_.back().jump;
    any_ |= axes_.back().ramp.limits();
  }
}

double JerkTimeBound::until(const Axis& axis, const Way& way, const RampBound::End& end) {
  return way.began + axis.ramp.least_time(way.start, end, way.length, std::sqrt(way.top));
}

// The axis stands, or is about to turn back.
double JerkTimeBound::stop(Axis& axis, double time, const RampBound::End& end) {
  if (axis.direction != 0) {
    time = std::max({time, until(axis, axis.whole, end), until(axis, axis.part, end)});
  }
  axis.direction = 0;
  axis.start = 0;
  axis.steady = end.steady;
  return time;
}

double JerkTimeBound::enter(const Rides& rides, double time) {
  // First all ends: what they tell counts for all ways that begin here.
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    Axis& axis = axes_[i];
    const Ride& ride = rides[i];
    if (!axis.ramp.limits() || axis.direction == 0) continue;
    if (!(axis.direction * ride.way > 0)) {
      time = stop(axis, time, {.steady = ride.way == 0});
    } else if (axis.falls && ride.exit > ride.entry) {
      time = std::max(time, until(axis, axis.part, {.speed = std::sqrt(ride.entry)}));
    }
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    Axis& axis = axes_[i];
    const Ride& ride = rides[i];
    if (!axis.ramp.limits()) continue;
    if (ride.way == 0) {
      axis.steady = true;
      axis.start = 0;
      continue;
    }
    if (axis.direction == 0) {
      const double start = std::min(axis.start, std::sqrt(ride.entry));
      axis.whole = axis.part = {.began = time, .start = {.speed = start, .steady = axis.steady}};
    } else if (axis.falls && ride.exit > ride.entry) {
      axis.part = {.began = time, .start = {.speed = std::sqrt(ride.entry)}};
    }
    axis.direction = ride.way > 0 ? 1 : -1;
    axis.exit = std::sqrt(ride.exit);
    axis.falls = ride.exit < ride.entry || (axis.falls && ride.exit == ride.entry);
    for (Way* const way : {&axis.whole, &axis.part}) {
      way->length += std::abs(ride.way);
      way->top = std::max(way->top, ride.top);
    }
  }
  return time;
}

double JerkTimeBound::rest(double time, bool steady) {
  for (Axis& axis : axes_) {
    if (axis.ramp.limits()) time = stop(axis, time, {.speed = std::min(axis.jump, axis.exit), .steady = steady});
  }
  for (Axis& axis : axes_) {
    axis.start = axis.jump;
    axis.steady = steady;
  }
  return time;
}

}  // namespace passo::proof
