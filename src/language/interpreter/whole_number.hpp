// Values of a program that must be whole numbers: parameter numbers, labels and counts. They may be computed, so small
// rounding errors are accepted.
#pragma once

#include <cmath>
#include <optional>

namespace passo {

inline constexpr double whole_tolerance = 1e-4;  // LinuxCNC's value

inline bool is_whole(double value) {
  return std::abs(value - std::round(value)) <= whole_tolerance;
}

// Returns the whole number from `lowest` to `highest` that the value represents, if there is one.
inline std::optional<double> whole_within(double value, double lowest, double highest) {
  const double whole = std::round(value);
  if (!is_whole(value) || whole < lowest || whole > highest) return std::nullopt;
  return whole;
}

}  // namespace passo
