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

// Runs the method twice over the move: the first time its pulses are counted.
Result<Measures, std::string> measure(const Method& method, const StepMove& move);

// One pulse on.
void apply(Pulse pulse, Place& place);

}  // namespace passo
