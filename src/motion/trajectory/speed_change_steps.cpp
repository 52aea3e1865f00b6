// The way of a SpeedChange in steps: where the motion already uses a limit of an axis to the full, no strength that
// stays the same is possible. But a moment later the path has turned, or a little speed is gone, and there is room.
#include <algorithm>
#include <cmath>

#include "arithmetic.hpp"
#include "speed_change.hpp"

namespace passo {
namespace {

constexpr int steps_a_rise = 16;  // in the time in which the acceleration rises from 0 to its strongest
// Where little or nothing limits the jerk: in the time that braking takes. All steps together take three times as long.
constexpr int steps_a_braking = 128;
constexpr int most_steps_of_speed = 400;
constexpr int looks_ahead = 4;    // in the time of a rise
constexpr int looks_on_way = 16;  // on the way to rest
// Shares of a limit. The change uses the first at most, as the profile does (planned_share): on curves all of the limit
// would be found to be too much. The motion may use the second without the change.
constexpr double most_used = 0.998;
constexpr double used_up = 0.9985;
constexpr double no_slope = 1e-9;  // the path does not move the axis

// A place on the path, found going forward.
struct Walk {
  std::uint64_t segment = 0;
  double base = 0;  // of the segment's start, counted from the start of the change

  // The segment at that way. nullptr where the path ends or rests before.
  const Segment* at(PathAhead& path, double way) {
    const Segment* here = path.at(segment);
    while (here != nullptr && way > base + here->curve.length().value()) {
      base += here->curve.length().value();
      here = path.after(segment++);
    }
    return here;
  }
};

// What the axes leave for a rate along the path, an acceleration or a jerk: slope · rate + used lies within each limit.
struct Room {
  double low = -infinity;
  double high = infinity;

  // `share`: of the limit. What is used may use more, and then leaves the rate 0.
  void narrow(double slope, double used, double limit, double share) {
    if (!(std::abs(slope) > no_slope)) return;
    const double most = limit * std::max(std::min(share, most_used), std::min(std::abs(used) / limit, used_up));
    const double one = (-most - used) / slope;
    const double other = (most - used) / slope;
    low = std::max(low, std::min(one, other));
    high = std::min(high, std::max(one, other));
  }
};

// The least jerk along the path that the axes allow on this way, where it is straight. An axis that begins to move
// there may have a limit of jerk which those have not that move now.
double jerk_on(PathAhead& path, Walk walk, double way, const std::vector<LimitedAxis>& axes) {
  double least = infinity;
  for (int k = 0; k <= looks_on_way; ++k) {
    const double place = way * k / looks_on_way;
    const Segment* const segment = walk.at(path, place);
    if (segment == nullptr) break;
    const Point slope = segment->curve.tangent(std::clamp(Mm(place - walk.base), Mm(0), segment->curve.length()));
    for (const LimitedAxis& axis : axes) {
      const double part = std::abs(axis.row.of(slope));
      if (part > no_slope) least = std::min(least, axis.jerk / part);
    }
  }
  return least;
}

}  // namespace

struct SpeedChange::Rooms {
  Room accelerations;
  Room jerks;

  // Takes in a place of the segment that is passed with that speed and acceleration.
  void narrow(const Segment& segment, double s, double v, double a, const std::vector<LimitedAxis>& axes,
              const Strength& share) {
    const Mm place = std::clamp(Mm(s), Mm(0), segment.curve.length());
    const Point first = segment.curve.tangent(place);
    const Point second = segment.curve.second_derivative(place);
    const Point third = segment.curve.third_derivative(place);
    double common = 0;
    double whole = 0;
    for (const LimitedAxis& axis : axes) {
      common += axis.row.of(third) * axis.row.of(first);
      whole += axis.row.of(first) * axis.row.of(first);
    }
    const double along = common / whole;
    for (const LimitedAxis& axis : axes) {
      const double q1 = axis.row.of(first);
      const double q2 = axis.row.of(second);
      const double q3 = axis.row.of(third);
      accelerations.narrow(q1, q2 * v * v, axis.acceleration_at(q1 * q1 * v * v), share.acceleration);
      // No jerk along the path balances what is across.
      accelerations.narrow(3 * q2 * v, (q3 - along * q1) * v * v * v, axis.jerk, share.jerk);
      jerks.narrow(q1, 3 * q2 * v * a + q3 * v * v * v, axis.jerk, share.jerk);
    }
  }
};

// Slows down as fast as the places and the strength allow, step by step, until what is left of the speed goes with the
// acceleration. Returns false if that leads nowhere. What lies between the steps is looked at afterwards, as ever.
bool SpeedChange::shape_in_steps(PathAhead& path, const PathState& state, const Request& request,
                                 const Strength& strength, const Strength& share) {
  phases_.clear();
  chain_ = {.speed = state.speed, .acceleration = state.acceleration};
  end_.speed = request.exit;
  Walk walk{.segment = state.segment, .base = -state.s};
  const double braking = state.speed / strength.acceleration;
  const double jerk =
      std::min(strength.jerk, share.jerk * jerk_on(path, walk, braking * state.speed / 2, request.axes));
  const double step = std::max(strength.acceleration / strength.jerk / steps_a_rise, braking / steps_a_braking);
  const double rise = std::max(strength.acceleration / jerk, step);
  for (int count = 0; count < most_steps_of_speed; ++count) {
    const double v = chain_.speed;
    const double a = chain_.acceleration;
    if (a < 0 && v + a * step - a * a / (2 * jerk) <= end_.speed) {
      const double left = v - end_.speed;
      if (!(left > 0)) return false;
      add(2 * left / -a, a * a / (2 * left));
      chain_.acceleration = 0;
      return true;
    }
    if (walk.at(path, chain_.at) == nullptr) return false;
    Rooms here{.accelerations = {.low = -strength.acceleration},
               .jerks = {.low = -strength.jerk, .high = strength.jerk}};
    Rooms later;
    const auto look = [&](double time, Rooms& rooms) {
      const double speed = std::max(v + a * time, 0.0);
      const double way = chain_.at + (v + speed) / 2 * time;
      Walk there = walk;
      if (const Segment* segment = there.at(path, way))
        rooms.narrow(*segment, way - there.base, speed, a, request.axes, share);
    };
    look(0, here);
    look(step, here);
    for (int k = 1; k <= looks_ahead; ++k) look(rise * k / looks_ahead, later);
    if (!(here.jerks.low <= here.jerks.high)) return false;
    const double least = std::max(here.accelerations.low, later.accelerations.low);
    add(step, std::clamp((std::min(least, 0.0) - a) / step, here.jerks.low, here.jerks.high));
  }
  return false;
}

}  // namespace passo
