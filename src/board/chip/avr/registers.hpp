// The registers of the ATmega328P and the ATmega2560 that the firmware uses, by their addresses in data memory.
//
// The two chips have all of these at the same addresses; only the interrupt vectors and the ports differ.
#pragma once

#include <stdint.h>

namespace passo::chip {

// Returns the number of a register for `in`, `out` and `sbic`.
constexpr uint8_t io(uint16_t address) {
  return static_cast<uint8_t>(address - 0x20);
}

template <uint16_t address>
struct Register {
  static constexpr uint16_t where = address;
  static uint8_t read() { return *reinterpret_cast<volatile uint8_t*>(address); }
  static void write(uint8_t value) { *reinterpret_cast<volatile uint8_t*>(address) = value; }
};

// PINx at `address`, then DDRx and PORTx. A one written to PINx toggles a single bit: neighbouring pins stay unchanged,
// even if the interrupt comes in between.
template <uint16_t address>
struct Port {
  static uint8_t pins() { return Register<address>::read(); }
  static void output(uint8_t mask) { Register<address + 1>::write(mask); }
  static void set(uint8_t mask, bool high) {
    const uint8_t now = Register<address + 2>::read();
    Register<address>::write(static_cast<uint8_t>((high ? ~now : now) & mask));
  }
};

using Tifr0 = Register<0x35>;
using Tifr1 = Register<0x36>;
using Tifr4 = Register<0x39>;  // only in the ATmega2560, like all of timers 4 and 5
using Pcifr = Register<0x3b>;
using Eifr = Register<0x3c>;
using Gpior0 = Register<0x3e>;
using Eecr = Register<0x3f>;  // the EEPROM is not used: its registers are free
using Eedr = Register<0x40>;
using Eearl = Register<0x41>;
using Tccr0a = Register<0x44>;
using Tccr0b = Register<0x45>;
using Tcnt0 = Register<0x46>;
using Ocr0a = Register<0x47>;
using Ocr0b = Register<0x48>;  // this compare match is not used
using Gpior1 = Register<0x4a>;
using Gpior2 = Register<0x4b>;
using Mcusr = Register<0x54>;
using Sreg = Register<0x5f>;
using Wdtcsr = Register<0x60>;
using Pcicr = Register<0x68>;
using Eicra = Register<0x69>;
using Eicrb = Register<0x6a>;
using Pcmsk0 = Register<0x6b>;
using Pcmsk1 = Register<0x6c>;
using Pcmsk2 = Register<0x6d>;
using Timsk0 = Register<0x6e>;
using Timsk1 = Register<0x6f>;
using Tccr1a = Register<0x80>;
using Tccr1b = Register<0x81>;
using Tcnt1l = Register<0x84>;
using Tcnt1h = Register<0x85>;
using Ocr1al = Register<0x88>;
using Ocr1ah = Register<0x89>;
using Ocr1bl = Register<0x8a>;  // its high byte is written first
using Ocr1bh = Register<0x8b>;
using Tccr4a = Register<0xa0>;
using Tccr4b = Register<0xa1>;
using Ocr4cl = Register<0xac>;
using Ocr4ch = Register<0xad>;
using Tccr2a = Register<0xb0>;
using Tccr2b = Register<0xb1>;
using Tcnt2 = Register<0xb2>;
using Ocr2a = Register<0xb3>;
using Ocr2b = Register<0xb4>;  // this compare match is not used
using Twbr = Register<0xb8>;   // the two-wire interface is off
using Twar = Register<0xba>;
using Ucsr0a = Register<0xc0>;
using Ucsr0b = Register<0xc1>;
using Ucsr0c = Register<0xc2>;
using Ubrr0l = Register<0xc4>;
using Ubrr0h = Register<0xc5>;
using Udr0 = Register<0xc6>;
using Tccr5a = Register<0x120>;
using Tccr5b = Register<0x121>;
using Tcnt5l = Register<0x124>;
using Tcnt5h = Register<0x125>;

inline constexpr uint8_t timer_overflow = 1 << 0;   // in TIFR1: every 65,536 cycles
inline constexpr uint8_t compare_match_a = 1 << 1;  // in TIFR0, TIMSK0, TIFR1 and TIMSK1
inline constexpr uint8_t input_captured = 1 << 5;   // in TIFR4
inline constexpr uint8_t byte_received = 1 << 7;    // in UCSR0A
inline constexpr uint8_t may_send = 1 << 5;

}  // namespace passo::chip

// Assembly: moves a received byte from the UART to the ring and jumps back to 1, or jumps to 2 if there is none. 13
// cycles to the last store. Changes r24, r30 and r31; %[ucsra], %[udr] and %[received] are operands.
#define PASSO_TAKE_BYTE         \
  "lds r24, %[ucsra]\n"         \
  "sbrs r24, 7\n"               \
  "rjmp 2f\n"                   \
  "lds r30, received_head\n"    \
  "ldi r31, hi8(%[received])\n" \
  "lds r24, %[udr]\n"           \
  "st Z+, r24\n"                \
  "sts received_head, r30\n"    \
  "rjmp 1b\n"
