// EmulatedBoard: a real board's firmware on the emulated chip, at the other end of its serial line. A link cannot tell
// it from a board on the desk.
//
// Its time is the chip's, and passes only in run(): the same program gives the same figures everywhere. It looks at the
// pins themselves, as a driver does, counts the steps that come out of them, and drives a plant by them.
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
#include "passo/plant/plant.hpp"

namespace passo {

class EmulatedBoard : public BoardPort {
 public:
  // `kind`: one of emulated_boards; `program`: the firmware's ELF file. The error is a sentence with the reason.
  static Result<std::unique_ptr<EmulatedBoard>, std::string> start(std::string_view kind, const std::string& program);

  // Of each motor, in steps from the start: a step is a rising edge, backwards while the direction pin is high; or the
  // next pattern of its windings.
  virtual std::vector<std::int64_t> positions() const = 0;
  // Called with each of these steps, in the order of its pins, and the cycle of its edge.
  std::function<void(std::uint64_t cycle, std::size_t motor, bool down)> on_step;

  // At the start. The plant outlives the board's last run(). Until then the board has an ideal one of its own, with
  // nothing but motors and a spindle. Each step goes to the plant; the pins of the switches and of the encoder, where
  // the board has such, are as the plant says. Of a spindle only the Mega's speed output is seen. What somebody else
  // does to the plant the board sees in its next run().
  virtual void connect(Plant& plant) = 0;
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
