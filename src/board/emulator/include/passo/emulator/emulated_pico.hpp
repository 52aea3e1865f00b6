// EmulatedPico: a Raspberry Pi Pico, emulated in a separate process (src/board/emulator/pico, rp2040js on node). A pin
// is a GPIO. Cycles are those of the chip's 128 MHz clock. Needs node, and `npm ci` in src/board/emulator/pico
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
// The port to which the host is connected.
enum class PicoSocket { usb, uart };

class EmulatedPico : public EmulatorProcess {
 public:
  // `program`: a UF2 file. The error is a sentence with the reason.
  static Result<std::unique_ptr<EmulatedPico>, std::string> start(const std::string& program, const PicoPins& pins,
                                                                  PicoSocket socket = PicoSocket::usb);

 private:
  using EmulatorProcess::EmulatorProcess;
};

// The same as EmulatedBoard::start(), for a kind in pico_boards.
Result<std::unique_ptr<EmulatedBoard>, std::string> start_pico_board(std::string_view kind, const std::string& program);

}  // namespace passo
