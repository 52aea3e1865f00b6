// EmulatedBoard: a real board's firmware on the emulated chip, at the other end of its serial line. A link cannot tell
// it from a board on the desk.
//
// Its time is the chip's, and passes only in run(): the same program gives the same figures everywhere. Besides it
// looks at the pins themselves, as a driver does, and counts the steps that come out of them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/link/board_port.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// What hangs on the board's spindle output, and on its encoder's pins.
struct EmulatedSpindle {
  int pulses_per_turn = 0;
  // Revolutions a minute from that time on, below 0 the other way, as the board's pins command it.
  std::function<void(Seconds time, double revolutions_per_minute)> command;
  std::function<double(Seconds time)> turns;  // since the start
};

class EmulatedBoard : public BoardPort {
 public:
  // `kind`: one of emulated_boards; `program`: the firmware's ELF file. The error is a sentence with the reason.
  static Result<std::unique_ptr<EmulatedBoard>, std::string> start(std::string_view kind, const std::string& program);

  // Of each motor, in steps from the start: a step is a rising edge, backwards while the direction pin is high; or the
  // next pattern of its windings.
  virtual std::vector<std::int64_t> positions() const = 0;
  // Called with each of these steps, in the order of its pins, and the cycle of its edge.
  std::function<void(std::uint64_t cycle, std::size_t motor, bool down)> on_step;

  // Whether the probe is touched while the motors stand there; asked now, and behind each step.
  virtual void set_touch(std::function<bool(const std::vector<std::int64_t>& positions)> touches) = 0;
  // At the start. False where the board has no pins for an encoder.
  virtual bool fit_spindle(EmulatedSpindle spindle) = 0;
  // Closes a switch, or opens it. False where the board has no such.
  virtual bool set_switch(BoardInput which, bool closed) = 0;
};

// Those that there are: with drivers for step and direction, and with the windings on the board's own pins.
inline constexpr std::array<std::string_view, 8> emulated_boards = {
    "uno", "uno_two_on", "uno_wave", "uno_half_step", "mega", "mega_two_on", "mega_wave", "mega_half_step"};
constexpr bool is_emulated_board(std::string_view kind) {
  for (const std::string_view one : emulated_boards) {
    if (one == kind) return true;
  }
  return false;
}

}  // namespace passo
