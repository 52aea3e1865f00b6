// TouchBody: something that stands on a virtual machine, for its probe to touch: a box in steps of the motors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "passo/wire/board_segment.hpp"

namespace passo {

// The machine is in it where every motor's position is from its `low` to its `high`, both included.
struct TouchBody {
  struct Range {
    std::int64_t low = INT64_MIN;
    std::int64_t high = INT64_MAX;
  };
  std::array<Range, max_motors> motors{};

  // `positions`: of as many motors as there are.
  bool contains(std::span<const std::int64_t> positions) const {
    for (std::size_t m = 0; m < positions.size(); ++m) {
      if (positions[m] < motors[m].low || positions[m] > motors[m].high) return false;
    }
    return true;
  }
};

}  // namespace passo
