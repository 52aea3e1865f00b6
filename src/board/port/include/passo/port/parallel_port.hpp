// ParallelPort: a PC's parallel port in its standard mode: three registers, and the levels on the pins of its DB25
// connector.
//
// The program writes the data and the control register and reads the status register; each bit has one pin. Some bits
// are inverted: the pin is high while the bit is 0. Pins 18 to 25 are ground.
//
//   register           bit 0     1     2     3     4    5    6    7
//   data    (base)     pin 2     3     4     5     6    7    8    9
//   status  (base + 1)                      15    13   12   10   11 inverted
//   control (base + 2)     1     14    16   17
//                        inv.  inv.        inv.
#pragma once

#include <cstdint>
#include <optional>

namespace passo {

class ParallelPort {
 public:
  static constexpr std::uint16_t usual_base = 0x378;  // the I/O address of the data register
  static constexpr int pin_count = 25;
  enum class Register : std::uint8_t { data, status, control };  // at the base address, and at the two after it

  // The bit of a register that belongs to a pin.
  struct Bit {
    Register of = Register::data;
    unsigned number = 0;    // 0 to 7
    bool inverted = false;  // the pin is high while the bit is 0
    friend bool operator==(const Bit&, const Bit&) = default;
  };
  // Empty for ground, and for a number that is no pin.
  static std::optional<Bit> bit_of(int pin);

  // Writes a register. The status register cannot be written: nothing changes. Only bits 0 to 3 of the control register
  // have pins.
  void write(Register to, std::uint8_t value);
  // Reads a register: of data and control what was written, of status the input pins. Bits without a pin are 0.
  std::uint8_t read(Register from) const;

  // Returns the level of a pin. Ground, and a number that is no pin, is low.
  bool level(int pin) const;
  // Sets the level of an input (pins 10 to 13 and 15) from outside. Other pins do not change.
  void set_input(int pin, bool high);

 private:
  std::uint8_t& latch_of(Register which);

  std::uint8_t data_ = 0;
  std::uint8_t status_ = 0x80;  // all inputs low
  std::uint8_t control_ = 0;
};

}  // namespace passo
