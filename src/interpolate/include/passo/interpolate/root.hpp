// The square root of a whole number, rounded to the nearest whole number. 32 rounds of shift and compare.
// Portable.
#pragma once

#include <stdint.h>

namespace passo {

constexpr uint32_t rounded_root(uint64_t square) {
  uint64_t root = 0;
  for (uint64_t bit = uint64_t{1} << 31; bit != 0; bit >>= 1) {
    const uint64_t larger = root | bit;
    if (larger * larger <= square) root = larger;
  }
  return static_cast<uint32_t>(square - root * root > root ? root + 1 : root);
}

}  // namespace passo
