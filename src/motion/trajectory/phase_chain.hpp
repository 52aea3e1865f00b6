// PhaseChain: phases of constant jerk, each of which begins at the end of the previous one. Private to trajectory/.
#pragma once

#include <optional>

#include "passo/trajectory/phase.hpp"

namespace passo {

// In seconds. A shorter phase is a rounding error: this is the spacing of doubles at some hundred seconds, the duration
// of a long move.
inline constexpr double shortest_phase = 1e-13;

// The position and the state at the chain's end, in mm and seconds.
struct PhaseChain {
  double at = 0;
  double speed = 0;
  double acceleration = 0;

  // Returns the next phase. Nothing if it would be too short.
  std::optional<Phase> next(double duration, double jerk) {
    if (!(duration > shortest_phase)) return std::nullopt;
    const Phase phase{.duration = Seconds(duration),
                      .start = Mm(at),
                      .velocity = MmPerSecond(speed),
                      .acceleration = MmPerSecond2(acceleration),
                      .jerk = MmPerSecond3(jerk)};
    at = phase.position_at(phase.duration).value();
    speed = phase.velocity_at(phase.duration).value();
    acceleration = phase.acceleration_at(phase.duration).value();
    return phase;
  }
};

}  // namespace passo
