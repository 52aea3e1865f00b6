// Lanes: one value for each of several events that are computed in parallel.
//
// An event's values depend on each other through square roots and divisions, for which the processor would wait. Events
// computed in parallel fill these waits, and the compiler vectorises plain loops over all lanes. A loop also computes
// unused lanes: their values are arbitrary.
#pragma once

#include <array>
#include <cstddef>

namespace passo {

inline constexpr std::size_t lane_count = 16;
using Lanes = std::array<double, lane_count>;

// Each lane's number. Converting the loop counter instead would prevent vectorisation.
inline constexpr Lanes lane_numbers = [] {
  Lanes numbers{};
  for (std::size_t i = 0; i < lane_count; ++i) numbers[i] = static_cast<double>(i);
  return numbers;
}();

}  // namespace passo
