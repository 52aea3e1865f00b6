// The square root of a whole number below (2³² − ½)², rounded to the nearest whole number. Each iteration finds one bit
// of the root by shift and subtract, because an 8-bit chip has no 64-bit product. Portable.
#pragma once

#include <stdint.h>

namespace passo {

constexpr uint32_t rounded_root(uint64_t square) {
  uint64_t root = 0;
  uint64_t rest = square;
  for (uint64_t bit = uint64_t{1} << 62; bit != 0; bit >>= 2) {
    if (rest >= root + bit) {
      rest -= root + bit;
      root = (root >> 1) + bit;
    } else {
      root >>= 1;
    }
  }
  return static_cast<uint32_t>(root + (rest > root ? 1 : 0));
}

}  // namespace passo
