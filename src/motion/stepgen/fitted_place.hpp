// Places as the segment fitter counts them, in 1/65536 step.
#pragma once

#include <cstdint>

namespace passo {

// A motor that moves less than this in one event stands still.
inline constexpr double still = 1e-4;

// A place within one segment, in 1/65536 step from the start of the step in which the motor is. The steps of a segment
// fit 32 bits, and the processor computes twice as many of these at once.
inline std::int32_t step_of(std::int32_t place) {
  return place >> 16;
}
// Halves away from zero.
inline std::int64_t nearest(double x) {
  return static_cast<std::int64_t>(x + (x < 0 ? -0.5 : 0.5));
}

// The place in the direction of travel. For a motor that goes down, the complement mirrors the place: what is left of a
// step becomes what is done of the step.
inline std::int64_t along(int sign, std::int64_t position) {
  return sign > 0 ? position : ~position;
}

}  // namespace passo
