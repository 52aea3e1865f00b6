// Measures: quality figures of a method for a move.
//
// Deviation is the distance of the tool from the ideal path after a pulse that moved it. Uniformity of speed is
// measured under three rules for the duration of a pulse, all with the same total time:
//
//   beats   every pulse has the same duration
//   roots   a pulse of n axes lasts √n times a plain one; a pulse without motion takes no time
//   exact   the time in which the projection of the tool onto the ideal path passes at constant speed
//
// Two figures describe the nonuniformity. The lag is the maximum distance of the projection from a point that moves
// along the ideal path at constant speed, ahead or behind. The ratio is the speed of the fastest step divided by that
// of the slowest; a step's speed is the tool's distance divided by the time since it last moved.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "passo/base/result.hpp"
#include "passo/study/method.hpp"

namespace passo {

enum class SpeedRule : std::uint8_t { beats, roots, exact };
inline constexpr std::size_t speed_rules = 3;

struct Evenness {
  double lag = 0;    // steps along the path
  double ratio = 1;  // speed of the fastest over the slowest step; 1 is uniform
};

struct Measures {
  std::int64_t pulses = 0;
  std::int64_t together = 0;     // number of pulses in which two or more axes step
  std::int64_t idle = 0;         // number of pulses in which no axis steps
  double largest_deviation = 0;  // maximum deviation, steps
  double mean_deviation = 0;
  std::array<Evenness, speed_rules> evenness;  // indexed by SpeedRule
};

// The state after a pulse.
struct Followed {
  Pulse pulse;
  const Place& place;
  double progress = 0;   // fraction of the ideal path at the projection, 0 … 1
  double deviation = 0;  // steps
};

// Runs the method over the move and calls `visit` after each pulse. Fails with the reason if the method does not
// support the move.
Status<std::string> follow(const Method& method, const StepMove& move,
                           const std::function<void(const Followed&)>& visit);

// Runs the method twice over the move; the first time only counts its pulses. `watch` is called from time to time with
// the completed fraction.
Result<Measures, std::string> measure(const Method& method, const StepMove& move,
                                      const std::function<void(double)>& watch = nullptr);

// The time after each pulse under one rule, from 0 to 1 over the whole move.
class SpeedClock {
 public:
  // `pulses` and `way` are those of the whole move; `way` is the sum of way_of() over its pulses.
  SpeedClock(SpeedRule rule, std::int64_t pulses, double way);
  double after(const Followed& followed);

 private:
  SpeedRule rule_;
  double total_;
  double done_ = 0;
};

// Returns √n for a pulse of n axes: the distance that it moves the tool, in steps.
double way_of(Pulse pulse);
// Moves `place` by one pulse.
void apply(Pulse pulse, Place& place);

}  // namespace passo
