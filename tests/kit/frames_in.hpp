// Finds complete frames in arbitrary bytes by examining each position separately. The code follows the text of
// docs/wire.md and does not use the Decoder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "passo/wire/wire_frame.hpp"

namespace passo::test {

// Returns the CRC of the bytes: the remainder of the division, computed bit by bit.
inline unsigned frame_crc(std::span<const std::uint8_t> bytes) {
  unsigned remainder = 0xffff;
  for (const std::uint8_t byte : bytes) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      const bool subtract = ((remainder ^ byte >> bit) & 1U) != 0;
      remainder >>= 1;
      if (subtract) remainder ^= 0x8408;
    }
  }
  return remainder;
}

// Returns whether a frame begins at the first of these bytes.
inline bool begins_with_frame(std::span<const std::uint8_t> bytes, std::uint8_t motors) {
  if (bytes.size() < frame_overhead || bytes[0] != sync_byte) return false;
  const std::size_t payload = payload_size(bytes[2], motors);
  if (payload == 0 || bytes.size() < frame_overhead + payload) return false;
  const std::span<const std::uint8_t> covered = bytes.subspan(1, 3 + payload);
  for (const std::uint8_t byte : covered) {
    if (byte == sync_byte) return false;
  }
  const std::size_t behind = 1 + covered.size();
  return frame_crc(covered) == (bytes[behind] | static_cast<unsigned>(bytes[behind + 1]) << 8);
}

inline int frames_in(std::span<const std::uint8_t> bytes, std::uint8_t motors) {
  int count = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) count += begins_with_frame(bytes.subspan(at), motors) ? 1 : 0;
  return count;
}

}  // namespace passo::test
