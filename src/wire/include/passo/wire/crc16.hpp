// CRC-16/MCRF4XX: the CCITT polynomial x^16 + x^12 + x^5 + 1, least significant bit first, as a serial line sends it.
//
// Initial value 0xFFFF, no final exclusive-or; "123456789" gives 0x6F91. avr-libc has the same as _crc_ccitt_update.
// Finds every error of up to three bits in a frame and every burst of up to sixteen. Portable: no table, on the host
// about 3 ns a byte.
#pragma once

#include <stdint.h>

namespace passo {

inline constexpr uint16_t crc16_start = 0xFFFF;

constexpr uint16_t crc16(uint16_t crc, uint8_t byte) {
  // Eight steps of the division at once: the quotient's bits are the byte and its own shift by four.
  uint8_t quotient = static_cast<uint8_t>(byte ^ crc);
  quotient = static_cast<uint8_t>(quotient ^ quotient << 4);
  return static_cast<uint16_t>((quotient << 8 | crc >> 8) ^ quotient >> 4 ^ quotient << 3);
}

}  // namespace passo
