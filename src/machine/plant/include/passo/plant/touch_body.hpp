// TouchBody: something in a plant that the probe can touch: a box in steps of the motors.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "passo/plant/motor_steps.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

// The probe touches the body where every motor's position is from its `low` to its `high`, both included.
struct TouchBody {
  struct Range {
    std::int64_t low = INT64_MIN;
    std::int64_t high = INT64_MAX;
  };
  std::array<Range, max_motors> motors{};

  bool contains(const MotorPositions& positions) const { return beyond(positions) <= 0; }

  // How many steps any motor may go until the probe may begin or cease to touch the body.
  double steps_to_border(const MotorPositions& positions) const {
    const double out = beyond(positions);
    return out > 0 ? out : 1 - out;
  }

 private:
  // The distance to the box for the motor that is furthest from it. Inside the box: 0 or less, the distance to the
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
