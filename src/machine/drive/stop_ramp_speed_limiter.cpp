#include "passo/drive/stop_ramp_speed_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

// Where a tail is too long the speed is limited to this part of what it is there: again after so much motion, in which
// the planner has braked; and where tails have been short enough for so long, the limit may rise by this part.
constexpr double slower = 0.7;
constexpr double slower_from_rest = 0.5;
constexpr Seconds to_settle{0.03};
constexpr double faster = 1.3;
constexpr Seconds to_go_on_so{0.1};
// In mm/s or degrees/s of the axis that moves the most. A path that mostly turns may have micrometres a second.
constexpr double least_limit = 0.05;

}  // namespace

StopRampSpeedLimiter::StopRampSpeedLimiter(Planner& planner, std::size_t places, std::size_t least_refill)
    : planner_(planner), long_tail_((places - std::min(places, least_refill + 1)) / 2) {}

void StopRampSpeedLimiter::record_given(const PlannedMove& move) {
  const double speed = move.exit_velocity().value();
  const Point slope = move.segment.curve.tangent(move.to);
  double steepest = 0;
  for (const double part : slope.values) steepest = std::max(steepest, std::abs(part));
  speed_ = {.on_path = speed, .of_axis = steepest * speed};
}

void StopRampSpeedLimiter::record_tail(std::size_t items) {
  const bool is_long = items > long_tail_;
  if (is_long && speed_.of_axis > least_limit && (std::isinf(limit_) || limited_for_ > to_settle)) {
    limit_to(std::min(limit_, speed_.on_path) * slower);
  } else if (!is_long && !std::isinf(limit_)) {
    const bool is_short = 2 * items < long_tail_;
    if (is_short && limited_for_ > to_settle) {
      limit_to(std::numeric_limits<double>::infinity());
    } else if (limited_for_ > to_go_on_so) {
      limit_to(limit_ * faster);
    }
  }
}

bool StopRampSpeedLimiter::begin_more_slowly(const Speed& highest) {
  if (highest.of_axis * slower_from_rest < least_limit) return false;
  // The present limit does not count. It was lowered in motion, and the motion may not have slowed down in time.
  limit_to(highest.on_path * slower_from_rest);
  return true;
}

void StopRampSpeedLimiter::limit_to(double speed) {
  if (speed < limit_) ++slowdowns_;
  limit_ = speed;
  limited_for_ = Seconds(0);
  planner_.limit_speed_to(MmPerSecond(speed));
}

}  // namespace passo
