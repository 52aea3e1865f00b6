// The time that a spindle needs to reach another speed, for which motion waits.
#pragma once

#include <cmath>

#include "passo/path/segment.hpp"

namespace passo {

// The time between two states of the outputs. `run_up`: the time from standstill to 1000 rpm. Motion does not wait for
// a spindle that is switched off.
inline Seconds run_up_time(const OutputState& from, const OutputState& to, Seconds run_up) {
  if (to.spindle == SpindleDirection::off) return Seconds(0);
  const auto speed = [](const OutputState& state) {
    if (state.spindle == SpindleDirection::off) return 0.0;
    return state.spindle == SpindleDirection::clockwise ? state.revolutions_per_minute : -state.revolutions_per_minute;
  };
  return run_up * (std::abs(speed(to) - speed(from)) / 1000);
}

}  // namespace passo
