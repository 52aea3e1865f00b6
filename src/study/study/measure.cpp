#include "passo/study/measure.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "passo/study/ideal_path.hpp"

namespace passo {
namespace {

// The number of pulses between two calls of `watch`.
constexpr std::int64_t pulses_between_looks = 1 << 18;

// The fastest and slowest step, and the lag, under one rule. Times run from 0 to 1 over the move.
class EvennessBuilder {
 public:
  void add(double time, double way, double progress) {
    lag_ = std::max(lag_, std::abs(progress - time));
    if (way == 0) return;
    const double speed = way / (time - before_);
    // The exact rule gives no time to an axis that does not move along the path. Such a step has no speed.
    if (time > before_) {
      fastest_ = std::max(fastest_, speed);
      slowest_ = std::min(slowest_, speed);
    }
    before_ = time;
  }
  Evenness result(double length) const {
    return {.lag = lag_ * length, .ratio = slowest_ < fastest_ ? fastest_ / slowest_ : 1};
  }

 private:
  double lag_ = 0;
  double before_ = 0;
  double fastest_ = 0;
  double slowest_ = INFINITY;
};

}  // namespace

void apply(Pulse pulse, Place& place) {
  for (std::size_t axis = 0; axis < place.size(); ++axis) {
    if ((pulse.steps >> axis & 1) == 0) continue;
    place[axis] += (pulse.directions >> axis & 1) != 0 ? -1 : 1;
  }
}

double way_of(Pulse pulse) {
  return std::sqrt(static_cast<double>(std::popcount(pulse.steps)));
}

SpeedClock::SpeedClock(SpeedRule rule, std::int64_t pulses, double way)
    : rule_(rule), total_(rule == SpeedRule::beats ? static_cast<double>(pulses) : way) {}

double SpeedClock::after(const Followed& followed) {
  if (rule_ == SpeedRule::exact) return followed.progress;
  done_ += rule_ == SpeedRule::beats ? 1 : way_of(followed.pulse);
  return done_ / total_;
}

Status<std::string> follow(const Method& method, const StepMove& move,
                           const std::function<void(const Followed&)>& visit) {
  auto source = start(method, move);
  if (!source) return Failure{source.error()};
  IdealPath path(move);
  Place place = move.from;
  while (!(*source)->done()) {
    const Pulse pulse = (*source)->next();
    apply(pulse, place);
    visit({.pulse = pulse, .place = place, .progress = path.progress(place), .deviation = path.distance(place)});
  }
  return Unit{};
}

Result<Measures, std::string> measure(const Method& method, const StepMove& move,
                                      const std::function<void(double)>& watch) {
  auto counted = start(method, move);
  if (!counted) return Failure{counted.error()};
  Measures found;
  double way = 0;
  for (; !(*counted)->done(); ++found.pulses) way += way_of((*counted)->next());

  std::array<SpeedClock, speed_rules> clocks = {SpeedClock(SpeedRule::beats, found.pulses, way),
                                                SpeedClock(SpeedRule::roots, found.pulses, way),
                                                SpeedClock(SpeedRule::exact, found.pulses, way)};
  std::array<EvennessBuilder, speed_rules> evenness;
  double deviations = 0;
  std::int64_t pulses = 0;
  const Status<std::string> followed = follow(method, move, [&](const Followed& now) {
    if (std::popcount(now.pulse.steps) > 1) ++found.together;
    if (now.pulse.steps == 0) ++found.idle;
    if (now.pulse.steps != 0) {
      found.largest_deviation = std::max(found.largest_deviation, now.deviation);
      deviations += now.deviation;
    }
    for (std::size_t rule = 0; rule < speed_rules; ++rule) {
      evenness[rule].add(clocks[rule].after(now), way_of(now.pulse), now.progress);
    }
    if (++pulses % pulses_between_looks == 0 && watch) {
      watch(static_cast<double>(pulses) / static_cast<double>(found.pulses));
    }
  });
  if (!followed) return Failure{followed.error()};
  const std::int64_t moving = found.pulses - found.idle;
  if (moving != 0) found.mean_deviation = deviations / static_cast<double>(moving);
  const double length = IdealPath(move).length();
  for (std::size_t rule = 0; rule < speed_rules; ++rule) found.evenness[rule] = evenness[rule].result(length);
  return found;
}

}  // namespace passo
