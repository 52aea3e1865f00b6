#include "passo/study/measure.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "ideal_path.hpp"

namespace passo {
namespace {

double way_of(Pulse pulse) {
  return std::sqrt(static_cast<double>(std::popcount(pulse.steps)));
}

struct Count {
  double pulses = 0;
  double way = 0;  // sum of the roots
};

// Fastest and slowest step, and the lag, under one rule. Times run from 0 to 1 over the move.
class EvennessBuilder {
 public:
  void add(double time, double way, double progress) {
    lag_ = std::max(lag_, std::abs(progress - time));
    if (way == 0) return;
    const double speed = way / (time - before_);
    // The exact rule gives an axis that does not move along the path no time at all; such a step says nothing.
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

Result<Measures, std::string> measure(const Method& method, const StepMove& move) {
  auto counted = start(method, move);
  if (!counted) return Failure{counted.error()};
  Count total;
  for (; !(*counted)->done(); ++total.pulses) total.way += way_of((*counted)->next());

  auto source = start(method, move);
  Measures found;
  IdealPath path(move);
  Place place = move.from;
  Count now;
  double deviations = 0;
  std::array<EvennessBuilder, speed_rules> evenness;
  while (!(*source)->done()) {
    const Pulse pulse = (*source)->next();
    const double way = way_of(pulse);
    apply(pulse, place);
    ++found.pulses;
    ++now.pulses;
    now.way += way;
    if (std::popcount(pulse.steps) > 1) ++found.together;
    if (pulse.steps == 0) ++found.idle;
    if (pulse.steps != 0) {
      const double deviation = path.distance(place);
      found.largest_deviation = std::max(found.largest_deviation, deviation);
      deviations += deviation;
    }
    const double progress = path.progress(place);
    evenness[0].add(now.pulses / total.pulses, way, progress);
    evenness[1].add(now.way / total.way, way, progress);
    evenness[2].add(progress, way, progress);
  }
  const std::int64_t moving = found.pulses - found.idle;
  if (moving != 0) found.mean_deviation = deviations / static_cast<double>(moving);
  for (std::size_t rule = 0; rule < speed_rules; ++rule) found.evenness[rule] = evenness[rule].result(path.length());
  return found;
}

}  // namespace passo
