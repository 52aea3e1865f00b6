// Pulse: the output of every interpolator, one beat at a time: which axes step, and in which direction.
//
// An interpolator is a value type with
//   bool done() const;   the end is reached, exactly
//   Pulse next();        the next beat; only when not done(). A beat in which nothing moves is a pulse too (DDA).
//
// Bit a belongs to axis a. Interpolators use additions, comparisons and shifts; one that divides does so only before
// the first pulse.
// Portable.
#pragma once

#include <stdint.h>

namespace passo {

inline constexpr uint8_t most_axes = 8;

struct Pulse {
  uint8_t steps = 0;       // the axes that make one step
  uint8_t directions = 0;  // the axes that count down when they step
};

}  // namespace passo
