// Pin: a pin of the chip, as data, and the address of its port's registers. Portable.
#pragma once

#include <stdint.h>

namespace passo {

struct Pin {
  char port = 0;  // 'A'…'L'; 0: there is none
  uint8_t bit = 0;

  constexpr bool exists() const { return port != 0; }
  constexpr uint8_t mask() const { return exists() ? static_cast<uint8_t>(1U << bit) : uint8_t{0}; }
  friend constexpr bool operator==(Pin a, Pin b) { return a.port == b.port && a.bit == b.bit; }
};

// The first of a port's three registers (PINx, DDRx, PORTx) in data memory, for the ATmega328P and the ATmega2560.
// There is no port I.
constexpr uint16_t port_registers(char port) {
  if (port <= 'G') return static_cast<uint16_t>(0x20 + 3 * (port - 'A'));
  return static_cast<uint16_t>(0x100 + 3 * (port == 'H' ? 0 : port - 'I'));
}

}  // namespace passo
