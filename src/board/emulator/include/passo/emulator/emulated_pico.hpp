// EmulatedPico: a Raspberry Pi Pico, emulated by a program of its own (src/board/emulator/pico, rp2040js on node). A
// pin is a GPIO. Cycles are the chip's, of 128 MHz. Needs node, and `npm ci` in src/board/emulator/pico
// (scripts/install.sh).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"
#include "passo/chip/pico_pins.hpp"
#include "passo/emulator/emulator_process.hpp"

namespace passo {

class EmulatedBoard;

using PicoChange = PinChange;
// Where the line is plugged in.
enum class PicoSocket { usb, uart };

class EmulatedPico : public EmulatorProcess {
 public:
  // `program`: a UF2 file. The error is a sentence with the reason.
  static Result<std::unique_ptr<EmulatedPico>, std::string> start(const std::string& program, const PicoPins& pins,
                                                                  PicoSocket socket = PicoSocket::usb);

 private:
  using EmulatorProcess::EmulatorProcess;
};

// As EmulatedBoard::start() for a kind that is one of pico_boards.
Result<std::unique_ptr<EmulatedBoard>, std::string> start_pico_board(std::string_view kind, const std::string& program);

}  // namespace passo
