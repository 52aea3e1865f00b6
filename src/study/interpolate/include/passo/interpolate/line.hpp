// Line: a straight move in whole steps, the input of the line interpolators.
//
// Distances are signed, −(2³¹−1) … 2³¹−1 steps for each axis; an axis with 0 does not move. Length is the unsigned type
// with which the interpolator counts. uint32_t supports every move. uint16_t supports moves of up to 32 767 steps, at
// half the cost on an 8-bit chip. Portable.
#pragma once

#include <stdint.h>

#include "passo/interpolate/pulse.hpp"

namespace passo {

// The signed type for a difference of two lengths, and the type for a square.
template <class Length>
struct LengthTraits;
template <>
struct LengthTraits<uint16_t> {
  using Signed = int16_t;
  using Square = int32_t;
  static constexpr uint8_t bits = 16;
};
template <>
struct LengthTraits<uint32_t> {
  using Signed = int32_t;
  using Square = int64_t;
  static constexpr uint8_t bits = 32;
};

// Returns |distance|, without the overflow that a negation may have.
template <class Length>
constexpr Length magnitude(int32_t distance) {
  const uint32_t value = static_cast<uint32_t>(distance);
  return static_cast<Length>(distance < 0 ? uint32_t{0} - value : value);
}

constexpr uint8_t axis_bit(uint8_t axis) {
  return static_cast<uint8_t>(1U << axis);
}

template <uint8_t axes, class Length>
struct Line {
  static_assert(axes >= 1 && axes <= most_axes);

  Length lengths[axes] = {};
  Length longest = 0;
  uint8_t directions = 0;  // bit a: axis a counts down

  constexpr explicit Line(const int32_t (&distances)[axes]) {
    for (uint8_t axis = 0; axis < axes; ++axis) {
      lengths[axis] = magnitude<Length>(distances[axis]);
      if (lengths[axis] > longest) longest = lengths[axis];
      if (distances[axis] < 0) directions = static_cast<uint8_t>(directions | axis_bit(axis));
    }
  }
};

// Two axes in the first octant. `along` steps the longer axis only; `both` is the diagonal.
template <class Length>
struct Octant {
  Length length;  // steps of the longer axis
  Length height;  // steps of the shorter axis
  Pulse along;
  Pulse both;

  constexpr explicit Octant(const int32_t (&distances)[2]) : Octant(Line<2, Length>(distances)) {}
  constexpr explicit Octant(const Line<2, Length>& line)
      : length(line.longest),
        height(line.lengths[0] < line.lengths[1] ? line.lengths[0] : line.lengths[1]),
        along{line.lengths[0] < line.lengths[1] ? axis_bit(1) : axis_bit(0), line.directions},
        both{static_cast<uint8_t>(axis_bit(0) | axis_bit(1)), line.directions} {}
};

}  // namespace passo
