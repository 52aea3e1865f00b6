// PathState: the state of a motion at a point on a segment of the path. Private to trajectory/.
#pragma once

#include <cstdint>

#include "passo/trajectory/phase.hpp"

namespace passo {

struct PathState {
  std::uint64_t segment = 0;  // its number in PathAhead
  double s = 0;               // mm along its curve
  double speed = 0;           // mm/s
  double acceleration = 0;    // mm/s²

  // Returns the state at the end of a move on that segment.
  static PathState behind(const PlannedMove& move, std::uint64_t segment) {
    const Phase& last = move.phases[move.phase_count - 1];
    const bool ends = move.to >= move.segment.curve.length();
    return {.segment = ends ? segment + 1 : segment,
            .s = ends ? 0 : move.to.value(),
            .speed = move.exit_velocity().value(),
            .acceleration = last.acceleration_at(last.duration).value()};
  }
};

}  // namespace passo
