// Computes the level of a pixel from 16-bit samples. Private to carve/.
#pragma once

#include <cstdint>

namespace passo {

inline std::uint64_t luminance_of(std::uint64_t red, std::uint64_t green, std::uint64_t blue) {
  return (2126 * red + 7152 * green + 722 * blue + 5000) / 10000;
}

// Darkens a luminance in proportion to its transparency.
inline std::uint16_t faded(std::uint64_t luminance, std::uint64_t alpha) {
  return static_cast<std::uint16_t>((luminance * alpha + 32767) / 65535);
}

}  // namespace passo
