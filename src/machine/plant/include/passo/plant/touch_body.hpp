// TouchBody: an object in a plant that the probe can touch: a box in motor steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "passo/plant/motor_steps.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

// The probe touches the body if every motor's position is between `low` and `high`, both included.
struct TouchBody {
  struct Range {
    std::int64_t low = INT64_MIN;
    std::int64_t high = INT64_MAX;
  };
  std::array<Range, max_motors> motors{};

  bool contains(const MotorPositions& positions) const { return beyond(positions) <= 0; }

  // Returns how many steps any motor may move until the probe may start or stop touching the body.
  double steps_to_border(const MotorPositions& positions) const {
    const double out = beyond(positions);
    return out > 0 ? out : 1 - out;
  }

 private:
  // Returns the largest distance of any motor to its range of the box. Inside the box: 0 or less, the distance to the
  // nearest side.
  double beyond(const MotorPositions& positions) const {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < motors.size(); ++m) {
      const double below = static_cast<double>(motors[m].low) - positions[m];
      const double above = positions[m] - static_cast<double>(motors[m].high);
      most = std::max({most, below, above});
    }
    return most;
  }
};

}  // namespace passo
