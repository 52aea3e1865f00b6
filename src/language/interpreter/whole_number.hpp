// Values of a program that must be whole: numbers of parameters, labels and counts. They may come from an expression,
// so rounding is forgiven.
#pragma once

#include <cmath>
#include <optional>

namespace passo {

inline constexpr double whole_tolerance = 1e-4;  // LinuxCNC's

inline bool is_whole(double value) {
  return std::abs(value - std::round(value)) <= whole_tolerance;
}

// The whole number from `lowest` to `highest` that the value means, if it means one.
inline std::optional<double> whole_within(double value, double lowest, double highest) {
  const double whole = std::round(value);
  if (!is_whole(value) || whole < lowest || whole > highest) return std::nullopt;
  return whole;
}

}  // namespace passo
