// Dda: a line by digital integration. Each axis has an N-bit register that contains its length, where 2ᴺ exceeds the
// longest length, and an N-bit accumulator. Each of 2ᴺ iterations adds the register to the accumulator; an overflow is
// a step.
//
// The total added is 2ᴺ·length, so each axis makes exactly its length in steps and the accumulators return to their
// initial values. They start at 0 (steps are late, the error is just below one step) or half full (the error is
// centred: half a step).
//
// Normalising, i.e. shifting all registers left until the top bit of the longest is set, avoids the idle iterations of
// a short move in a long register. Using the minimum number of bits for the longest length has the same effect, and is
// the default here. More bits are for comparison.
//
// The N bits are the high bits below the top bit of the word, so the overflow appears in the top bit: a single bit to
// test and clear. Any number of axes, lengths up to 2³¹−1. Pulses in which nothing moves are part of the method.
// Portable. Cost: docs/interpolation/costs.md.
#pragma once

#include "passo/interpolate/line.hpp"

namespace passo {

enum class DdaLoad : uint8_t { zero, half };

// Returns the minimum number of bits for `length`: the least N with 2ᴺ > length.
template <class Length>
constexpr uint8_t fewest_bits(Length length) {
  uint8_t bits = 0;
  for (; length != 0; length = static_cast<Length>(length >> 1)) ++bits;
  return bits;
}

template <uint8_t axes, class Length = uint32_t>
class Dda {
 public:
  static constexpr uint8_t most_bits = LengthTraits<Length>::bits - 1;

  constexpr explicit Dda(const int32_t (&distances)[axes], DdaLoad load = DdaLoad::zero)
      : Dda(distances, load, fewest_bits(Line<axes, Length>(distances).longest)) {}
  // `register_bits`: from the minimum for the longest axis to most_bits.
  constexpr Dda(const int32_t (&distances)[axes], DdaLoad load, uint8_t register_bits)
      : line_(distances), shift_(static_cast<uint8_t>(most_bits - register_bits)) {
    if (line_.longest == 0) return;
    left_ = static_cast<Length>(Length{1} << register_bits);
    for (uint8_t axis = 0; axis < axes; ++axis) {
      line_.lengths[axis] = static_cast<Length>(line_.lengths[axis] << shift_);
      accumulator_[axis] = load == DdaLoad::half ? half : Length{0};
    }
  }

  constexpr bool done() const { return left_ == 0; }
  constexpr Pulse next() {
    uint8_t steps = 0;
    for (uint8_t axis = 0; axis < axes; ++axis) {
      Length sum = static_cast<Length>(accumulator_[axis] + line_.lengths[axis]);
      if ((sum & overflow) != 0) {
        steps = static_cast<uint8_t>(steps | axis_bit(axis));
        sum = static_cast<Length>(sum - overflow);
      }
      accumulator_[axis] = sum;
    }
    --left_;
    return {steps, line_.directions};
  }

  constexpr uint32_t accumulator(uint8_t axis) const {
    return line_.longest == 0 ? 0 : static_cast<uint32_t>(accumulator_[axis] >> shift_);
  }

 private:
  static constexpr Length overflow = static_cast<Length>(Length{1} << most_bits);
  static constexpr Length half = static_cast<Length>(overflow / 2);

  Line<axes, Length> line_;  // the lengths are the registers
  uint8_t shift_;
  Length left_ = 0;
  Length accumulator_[axes] = {};
};

}  // namespace passo
