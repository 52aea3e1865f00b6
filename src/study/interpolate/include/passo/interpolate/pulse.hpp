// Pulse: the output of an interpolator for one iteration: which axes step, and in which direction.
//
// An interpolator is a value type with
//   bool done() const;   the end is reached, exactly
//   Pulse next();        the next pulse; only when not done(). It may be empty, i.e. without steps (DDA).
//
// Bit a belongs to axis a. Interpolators use additions, comparisons and shifts; divisions occur only before the first
// pulse. Portable.
#pragma once

#include <stdint.h>

namespace passo {

inline constexpr uint8_t most_axes = 8;

struct Pulse {
  uint8_t steps = 0;       // the axes that make one step
  uint8_t directions = 0;  // the axes that count down when they step
};

}  // namespace passo
