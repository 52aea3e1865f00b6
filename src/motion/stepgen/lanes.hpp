// Lanes: one value for each of several events that are computed side by side.
//
// An event's values follow from each other through roots and quotients. The processor would wait for each of them; side
// by side, the events fill these waits, and the compiler makes vectors of plain loops over all lanes. A loop computes
// lanes that nobody asked for, too: they may hold anything.
#pragma once

#include <array>
#include <cstddef>

namespace passo {

inline constexpr std::size_t lane_count = 16;
using Lanes = std::array<double, lane_count>;

// Each lane's number. A conversion of the loop's counter would keep the loop from becoming vectors.
inline constexpr Lanes lane_numbers = [] {
  Lanes numbers{};
  for (std::size_t i = 0; i < lane_count; ++i) numbers[i] = static_cast<double>(i);
  return numbers;
}();

}  // namespace passo
