// Fits a parabola to equidistant values. Private to trajectory/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace passo {

// Returns the maximum absolute value of the parabola through three equidistant values, between the first and the last.
inline double highest_through(const std::array<double, 3>& values) {
  const auto [first, second, third] = values;
  const double most = std::max({std::abs(first), std::abs(second), std::abs(third)});
  const double rise = third - first;
  const double bend = first - 2 * second + third;
  if (!(std::abs(rise) < 2 * std::abs(bend))) return most;
  return std::max(most, std::abs(second - rise * rise / (8 * bend)));
}

}  // namespace passo
