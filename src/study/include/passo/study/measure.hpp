// Measures: what a method made of a move, in figures.
//
// Deviation: the distance of the tool from the ideal path after a pulse that moved it. Evenness of speed, under three
// rules for how long a pulse lasts, all of which spend the same time on the whole move:
//
//   beats   every pulse the same
//   roots   a pulse of n axes √n times a plain one; none for a pulse that moves nothing
//   exact   as long as the foot of the tool on the ideal path takes at constant speed
//
// Unevenness is told in two ways: how far the foot is ever ahead of or behind a point that moves along the ideal path
// at constant speed (lag), and how much faster the fastest step is than the slowest (ratio; the tool's own way over the
// time since it last moved).
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
  double ratio = 1;  // fastest over slowest step; 1 is even
};

struct Measures {
  std::int64_t pulses = 0;
  std::int64_t together = 0;     // pulses in which two axes or more step
  std::int64_t idle = 0;         // pulses in which none does
  double largest_deviation = 0;  // steps
  double mean_deviation = 0;
  std::array<Evenness, speed_rules> evenness;  // by SpeedRule
};

// What there is to see after a pulse.
struct Followed {
  Pulse pulse;
  const Place& place;
  double progress = 0;   // of the foot on the ideal path, 0 … 1
  double deviation = 0;  // steps
};

// Runs the method over the move, or says why it does not take it.
Status<std::string> follow(const Method& method, const StepMove& move,
                           const std::function<void(const Followed&)>& visit);

// Runs the method twice over the move: the first time its pulses are counted. `watch` hears now and then what share of
// the work is done.
Result<Measures, std::string> measure(const Method& method, const StepMove& move,
                                      const std::function<void(double)>& watch = nullptr);

// The time after each pulse under one rule, 0 … 1 over the move.
class SpeedClock {
 public:
  // `pulses` and `way`: of the whole move; `way` is the sum of way_of() over its pulses.
  SpeedClock(SpeedRule rule, std::int64_t pulses, double way);
  double after(const Followed& followed);

 private:
  SpeedRule rule_;
  double total_;
  double done_ = 0;
};

// √n for a pulse of n axes: how far it moves the tool.
double way_of(Pulse pulse);
// One pulse on.
void apply(Pulse pulse, Place& place);

}  // namespace passo
