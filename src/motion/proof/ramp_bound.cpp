#include "ramp_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passo::proof {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int halvings_of_ramp = 100;
constexpr double precise = 1e-13;

// The speed at which the remaining distance becomes 0: at `low` some remains, at `high` none.
template <class Room>
double last_that_fits(double low, double high, const Room& room) {
  for (int i = 0; i < halvings_of_ramp && high - low > precise * high; ++i) {
    const double middle = (low + high) / 2;
    (room(middle) > 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace

RampBound::RampBound(double acceleration, double jerk)
    : acceleration_(acceleration > 0 ? acceleration : infinity), jerk_(jerk), limits_(jerk > 0) {}

RampBound::Ramp RampBound::ramp(const End& end, double peak) const {
  const double rise = peak - end.speed;
  if (end.steady) {
    const bool is_full = rise * jerk_ >= acceleration_ * acceleration_;
    const double time = is_full ? rise / acceleration_ + acceleration_ / jerk_ : 2 * std::sqrt(rise / jerk_);
    return {.time = time, .way = time * (end.speed + peak) / 2};
  }
  // The acceleration stays at its limit, and falls to 0 in the time `fall`.
  const double first = std::min(acceleration_, std::sqrt(2 * jerk_ * rise));
  const double fall = first / jerk_;
  const double before = rise - first * fall / 2;
  const double full = before > 0 ? before / first : 0;
  const double way = full * (end.speed + before / 2) + fall * (end.speed + before + first * fall / 3);
  return {.time = full + fall, .way = way};
}

// The faster end is too fast for the other one. If it is without acceleration, it is passed at the speed from which one
// ramp leads over the way.
double RampBound::time_between(const End& start, const End& end, double way) const {
  const bool begins_slow = start.speed < end.speed;
  const End& slow = begins_slow ? start : end;
  const End& fast = begins_slow ? end : start;
  if (!fast.steady) return 0;
  const auto room = [&](double peak) { return way - ramp(slow, peak).way; };
  return ramp(slow, last_that_fits(slow.speed, fast.speed, room)).time;
}

double RampBound::least_time(const End& start, const End& end, double way, double top) const {
  double low = std::max(start.speed, end.speed);
  double high = std::max(top, low);
  const auto room = [&](double peak) { return way - ramp(start, peak).way - ramp(end, peak).way; };
  if (!(way > 0) || !(high > 0)) return 0;
  if (!(room(low) > 0)) return time_between(start, end, way);
  if (room(high) < 0) high = last_that_fits(low, high, room);
  return ramp(start, high).time + ramp(end, high).time + std::max(room(high), 0.0) / high;
}

}  // namespace passo::proof
