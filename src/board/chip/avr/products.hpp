// Products: the multiplications that wire/segment_parts.hpp needs, and the steps in many events, by the chip's own
// 8-bit multiplier.
//
// LLVM would call the library's 32-bit product three times: about 500 cycles for a high_product(). This version takes
// 110 cycles. A decelerating part needs four of these products. The results are bit-identical: board_test.cpp compares
// the events.
#pragma once

#include <stdint.h>

namespace passo::chip {

// Returns the upper 16 bits of the product: upper_of().
[[gnu::always_inline]] inline int16_t upper_half(int16_t high, uint16_t low) {
  int16_t upper;
  uint8_t middle;
  uint8_t zero;
  asm volatile(
      "clr %2\n\t"
      "mulsu %B3, %B4\n\t"
      "movw %A0, r0\n\t"
      "mul %A3, %A4\n\t"
      "mov %1, r1\n\t"
      "mulsu %B3, %A4\n\t"
      "sbc %B0, %2\n\t"  // the sign of this product
      "add %1, r0\n\t"
      "adc %A0, r1\n\t"
      "adc %B0, %2\n\t"
      "mul %A3, %B4\n\t"
      "add %1, r0\n\t"
      "adc %A0, r1\n\t"
      "adc %B0, %2\n\t"
      "clr r1"
      : "=&r"(upper), "=&r"(middle), "=&r"(zero)
      : "a"(high), "a"(low)
      : "r0");
  return upper;
}

// Returns the whole product: product_of(). LLVM has no 32-bit operand.
[[gnu::always_inline]] inline int32_t whole_product(int16_t a, int16_t b) {
  int16_t upper;
  uint16_t lower;
  uint8_t zero;
  asm volatile(
      "clr %2\n\t"
      "muls %B3, %B4\n\t"
      "movw %A0, r0\n\t"
      "mul %A3, %A4\n\t"
      "movw %A1, r0\n\t"
      "mulsu %B3, %A4\n\t"
      "sbc %B0, %2\n\t"
      "add %B1, r0\n\t"
      "adc %A0, r1\n\t"
      "adc %B0, %2\n\t"
      "mulsu %B4, %A3\n\t"
      "sbc %B0, %2\n\t"
      "add %B1, r0\n\t"
      "adc %A0, r1\n\t"
      "adc %B0, %2\n\t"
      "clr r1"
      : "=&r"(upper), "=&r"(lower), "=&r"(zero)
      : "a"(a), "a"(b)
      : "r0");
  return static_cast<int32_t>(static_cast<uint32_t>(upper) << 16 | lower);
}

[[gnu::noinline]] inline int32_t high_product(int32_t a, int32_t b) {
  const int16_t a_high = static_cast<int16_t>(a >> 16);
  const int16_t b_high = static_cast<int16_t>(b >> 16);
  const int32_t sides =
      int32_t{upper_half(b_high, static_cast<uint16_t>(a))} + upper_half(a_high, static_cast<uint16_t>(b));
  return sides + whole_product(a_high, b_high);
}

// Adds `increment` to `accumulator` `events` times and returns the number of overflows. It is a 16 by 8 bit product,
// for which LLVM would call a 32-bit one.
inline uint8_t carries(uint16_t& accumulator, uint16_t increment, uint8_t events) {
  uint8_t count;
  asm volatile(
      "mul %A2, %3\n\t"
      "add %A1, r0\n\t"
      "adc %B1, r1\n\t"
      "clr %0\n\t"
      "adc %0, %0\n\t"
      "mul %B2, %3\n\t"
      "add %B1, r0\n\t"
      "adc %0, r1\n\t"
      "clr r1"
      : "=&r"(count), "+r"(accumulator)
      : "r"(increment), "r"(events)
      : "r0");
  return count;
}

}  // namespace passo::chip
