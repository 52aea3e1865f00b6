// What of a pixel is its level, from samples of 16 bits. Private to carve/.
#pragma once

#include <cstdint>

namespace passo {

inline std::uint64_t luminance_of(std::uint64_t red, std::uint64_t green, std::uint64_t blue) {
  return (2126 * red + 7152 * green + 722 * blue + 5000) / 10000;
}

// What is transparent counts as black, in proportion.
inline std::uint16_t faded(std::uint64_t luminance, std::uint64_t alpha) {
  return static_cast<std::uint16_t>((luminance * alpha + 32767) / 65535);
}

}  // namespace passo
