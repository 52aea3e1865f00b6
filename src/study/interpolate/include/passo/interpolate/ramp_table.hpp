// RampTable<N>: the factors k_n = √(n+1) − √n of a ramp with constant acceleration, cut off to 16 fraction bits.
//
// Step n of a motor that starts from rest takes c_n = K_b · k_n ticks. K_b depends on the motor and the move. k_n is
// the same for every motor, so a chip keeps the table in flash. The table is made at compile time, with integers, exact
// in every bit.
//
// k_0 = 1 does not fit and is not read (c_0 = K_b); its place is kept so that the index is the step. Each entry's error
// is below 1/65536. From n = 2^30 on the factor is 0. An entry takes two bytes.
// Portable.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace passo {

// Whether m/65536 <= √(n+1) − √n, for n >= 1 and m < 65536. Squaring twice removes the roots:
// m² n · 2^34 <= (2^32 − m²)².
constexpr bool ramp_factor_reaches(uint32_t m, uint32_t n) {
  const uint64_t square = uint64_t{m} * m;
  const uint64_t rest = (uint64_t{1} << 32) - square;
  return square * n <= (rest * rest) >> 34;
}

// Writes k_0 … k_(size−1). k falls as n grows, so the search for each entry starts at the one before.
constexpr void make_ramp_table(uint16_t* factors, size_t size) {
  uint16_t m = 0xffff;
  for (size_t n = 0; n < size; ++n) {
    while (n > 0 && !ramp_factor_reaches(m, static_cast<uint32_t>(n))) --m;
    factors[n] = m;
  }
}

// A TableRamp finds its entries by the two functions of a table reader: size() and scaled(). A reader of flash has the
// same two.
template <uint16_t N>
class RampTable {
  static_assert(N > 0, "a table without an entry has no speed to go on with");

 public:
  constexpr RampTable() { make_ramp_table(factors_, N); }
  static constexpr uint16_t size() { return N; }
  constexpr uint16_t operator[](uint16_t n) const { return factors_[n]; }

 private:
  uint16_t factors_[N] = {};
};

template <uint16_t N>
inline constexpr RampTable<N> ramp_table{};

// The reader of a table that the compiler made.
template <uint16_t N>
struct CompiledTable {
  static constexpr uint16_t size() { return N; }
  constexpr uint16_t operator[](uint16_t n) const { return ramp_table<N>[n]; }
  // first · k_n, cut off.
  constexpr uint16_t scaled(uint16_t first, uint16_t n) const {
    return static_cast<uint16_t>((uint32_t{first} * ramp_table<N>[n]) >> 16);
  }
};

}  // namespace passo
