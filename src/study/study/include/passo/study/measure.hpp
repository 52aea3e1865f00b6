// Measures: quality figures of a method for a move.
//
// Deviation is the distance of the tool from the ideal path after a pulse that moved it. Evenness of speed is measured
// under three rules for the duration of a pulse. All of them spend the same time on the whole move:
//
//   beats   every pulse lasts the same
//   roots   a pulse of n axes lasts √n times a plain one; a pulse that moves nothing takes no time
//   exact   as long as the foot of the tool on the ideal path needs at constant speed
//
// Two figures tell the unevenness. The lag is the greatest distance of the foot from a point that moves along the ideal
// path at constant speed, ahead or behind. The ratio is the speed of the fastest step over that of the slowest; a
// step's speed is the tool's way over the time since it last moved.
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
  double ratio = 1;  // speed of the fastest over the slowest step; 1 is even
};

struct Measures {
  std::int64_t pulses = 0;
  std::int64_t together = 0;     // pulses in which two axes or more step
  std::int64_t idle = 0;         // pulses in which no axis steps
  double largest_deviation = 0;  // steps
  double mean_deviation = 0;
  std::array<Evenness, speed_rules> evenness;  // indexed by SpeedRule
};

// The state after a pulse.
struct Followed {
  Pulse pulse;
  const Place& place;
  double progress = 0;   // of the foot on the ideal path, 0 … 1
  double deviation = 0;  // steps
};

// Runs the method over the move and calls `visit` after each pulse. Fails with the reason if the method does not take
// the move.
Status<std::string> follow(const Method& method, const StepMove& move,
                           const std::function<void(const Followed&)>& visit);

// Runs the method twice over the move; the first time only counts its pulses. `watch` is called now and then with the
// share of the work done.
Result<Measures, std::string> measure(const Method& method, const StepMove& move,
                                      const std::function<void(double)>& watch = nullptr);

// The time after each pulse under one rule, 0 … 1 over the move.
class SpeedClock {
 public:
  // `pulses` and `way` belong to the whole move; `way` is the sum of way_of() over its pulses.
  SpeedClock(SpeedRule rule, std::int64_t pulses, double way);
  double after(const Followed& followed);

 private:
  SpeedRule rule_;
  double total_;
  double done_ = 0;
};

// √n for a pulse of n axes: the distance that it moves the tool, in steps.
double way_of(Pulse pulse);
// Moves `place` by one pulse.
void apply(Pulse pulse, Place& place);

}  // namespace passo
