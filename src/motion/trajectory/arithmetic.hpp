// Numbers and functions that the sources of this module share.
// Private to trajectory.
#pragma once

#include <limits>

namespace passo {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

// A relative difference of squares of speeds, or of limits. Smaller ones are rounding: a thousand cells add up to about
// 1e-13.
inline constexpr double rounding = 1e-9;

constexpr double squared(double value) {
  return value * value;
}

}  // namespace passo
