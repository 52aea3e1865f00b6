// The positions used by the segment fitter, in 1/65536 step.
#pragma once

#include <cstdint>

namespace passo {

// A motor that moves less than this per event is treated as stopped.
inline constexpr double still = 1e-4;

// A position within one segment, in 1/65536 step from the start of the motor's current step. The steps of a segment fit
// into 32 bits, so a vector register holds twice as many positions as with 64 bits.
inline std::int32_t step_of(std::int32_t place) {
  return place >> 16;
}
// Rounds halves away from zero.
inline std::int64_t nearest(double x) {
  return static_cast<std::int64_t>(x + (x < 0 ? -0.5 : 0.5));
}

// Returns the position in the direction of travel. For a motor that moves down, the complement mirrors the position:
// the remaining part of a step becomes the completed part.
inline std::int64_t along(int sign, std::int64_t position) {
  return sign > 0 ? position : ~position;
}

}  // namespace passo
