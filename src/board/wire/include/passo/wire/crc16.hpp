// CRC-16/MCRF4XX: the CCITT polynomial x^16 + x^12 + x^5 + 1, least significant bit first, as on a serial link.
//
// Initial value 0xFFFF, no final exclusive-or; "123456789" gives 0x6F91. avr-libc has the same as _crc_ccitt_update. It
// detects every error of up to three bits in a frame, and every burst of up to sixteen bits. Portable: no table, about
// 3 ns per byte on the host.
#pragma once

#include <stdint.h>

namespace passo {

inline constexpr uint16_t crc16_start = 0xFFFF;

constexpr uint16_t crc16(uint16_t crc, uint8_t byte) {
  // Performs eight steps of the division at once: the quotient's bits are the byte, exclusive-or the byte shifted by
  // four. All operations are on single bytes, which halves the work on an 8-bit chip.
  const uint8_t first = static_cast<uint8_t>(byte ^ static_cast<uint8_t>(crc));
  const uint8_t quotient = static_cast<uint8_t>(first ^ static_cast<uint8_t>(first << 4));
  const uint8_t across =
      static_cast<uint8_t>(static_cast<uint8_t>(quotient >> 4) ^ static_cast<uint8_t>(quotient << 3));
  const uint8_t low = static_cast<uint8_t>(static_cast<uint8_t>(crc >> 8) ^ across);
  const uint8_t high = static_cast<uint8_t>(quotient ^ static_cast<uint8_t>(quotient >> 5));
  return static_cast<uint16_t>(high << 8 | low);
}

}  // namespace passo
