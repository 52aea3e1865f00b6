// PhaseChain: phases of constant jerk, each of which begins where the last one ended. Private to trajectory/.
#pragma once

#include <optional>

#include "passo/trajectory/phase.hpp"

namespace passo {

// In seconds. A shorter phase is rounding: doubles of some hundred seconds, as a long move takes, are so far apart.
inline constexpr double shortest_phase = 1e-13;

// The place and the state at the chain's end, in mm and seconds.
struct PhaseChain {
  double at = 0;
  double speed = 0;
  double acceleration = 0;

  // The next phase. Nothing where it would be too short.
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
