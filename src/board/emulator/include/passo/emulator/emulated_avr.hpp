// How an emulated AVR is started: the program passo-emulate-avr (src/board/emulator/avr) and its words.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/chip/pin.hpp"

namespace passo {

// The path of passo-emulate-avr: next to this program, or in the build folder. The error is a sentence.
Result<std::string, std::string> avr_emulator();

// Which of the emulator's 32 pins a pin of the chip is: numbers are given in the order of asking.
class PinNumbers {
 public:
  // The pin's bit. 0: there is no such pin.
  std::uint32_t bit_of(Pin pin) { return number(pin, false); }
  // The same for a pin whose bit is set while the chip draws the pin low.
  std::uint32_t bit_of_drawn_low(Pin pin) { return number(pin, true); }
  // All of them, as the emulator wants to be told.
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
