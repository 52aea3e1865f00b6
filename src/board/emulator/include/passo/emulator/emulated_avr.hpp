// Starts an emulated AVR: the program passo-emulate-avr (src/board/emulator/avr) and its arguments.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/chip/pin.hpp"

namespace passo {

// Returns the path of passo-emulate-avr: next to this program, or in the build folder. The error is a sentence.
Result<std::string, std::string> avr_emulator();

// Maps pins of the chip to the emulator's 32 pins, numbered in the order of the first request.
class PinNumbers {
 public:
  // Returns the pin's bit, or 0 if the pin does not exist.
  std::uint32_t bit_of(Pin pin) { return number(pin, false); }
  // The same for a pin whose bit is set while the chip drives the pin low.
  std::uint32_t bit_of_drawn_low(Pin pin) { return number(pin, true); }
  // Returns all pins in the format of the emulator's argument.
  std::string text() const;

 private:
  struct Numbered {
    Pin pin;
    bool when_drawn_low = false;
  };
  std::uint32_t number(Pin pin, bool when_drawn_low);

  std::vector<Numbered> pins_;
};

}  // namespace passo
