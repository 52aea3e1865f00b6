// EmulatedBoard: a real board's firmware on the emulated chip, at the end of a serial link. A host cannot tell an
// emulated board from a board on the desk.
//
// The board's time is the chip's, and passes only in run(), so a program gives the same results on every computer. The
// board watches the chip's pins, as a motor driver does, counts the steps output at the pins, and drives a plant with
// the steps.
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
#include "passo/wire/message.hpp"

namespace passo {

class EmulatedBoard : public BoardPort {
 public:
  // `kind`: one of emulated_boards. `program`: the firmware, an ELF file, or of the Pico a UF2 file. The error is a
  // sentence with the reason.
  static Result<std::unique_ptr<EmulatedBoard>, std::string> start(std::string_view kind, const std::string& program);

  // The position of each motor, in steps from the start. A step is an edge of the step pin to the pin's active level,
  // backwards while the direction pin is high, or the next pattern of the motor's windings. A driver that is not
  // enabled makes no step.
  virtual std::vector<std::int64_t> positions() const = 0;
  // Called for each of these steps, in the order of the pins, with the cycle of the edge.
  std::function<void(std::uint64_t cycle, std::size_t motor, bool down)> on_step;

  // Called when a pin of mist, flood or the spindle's direction changes, with the cycle of the edge and the pins that
  // are high, as bits of OutputSwitch.
  std::function<void(std::uint64_t cycle, std::uint8_t switches)> on_outputs;

  // Connects a plant; call it before the first run(). The plant must outlive the board's last run(). Until then the
  // board has an ideal plant of its own, with only motors and a spindle. Each step goes to the plant. The plant sets
  // the pins of the switches and of the encoder, where the board has such pins. Of the spindle's outputs, the plant
  // gets only the Mega's speed output. If other code changes the plant, the board sees the change in its next run().
  virtual void connect(Plant& plant) = 0;
  // Sets how the plant's switches and drivers are connected to the board's pins; call it before the first run(). By
  // default they are connected as in a default PinSetup.
  virtual void wire(const PinSetup& /*wiring*/) {}
};

// All kinds of emulated boards: with step and direction drivers, and with windings connected directly to the board's
// pins.
inline constexpr std::array<std::string_view, 13> emulated_boards = {
    "uno",  "uno_two_on", "uno_wave", "uno_half_step", "mega",   "mega_two_on", "mega_wave", "mega_half_step",
    "pico", "pico_lathe", "pico_mpg", "pico_eight",    "picobob"};
// Whether it is a Pico, whose image is a UF2 file.
constexpr bool is_pico(std::string_view kind) {
  return kind.starts_with("pico");
}
constexpr bool is_emulated_board(std::string_view kind) {
  for (const std::string_view one : emulated_boards) {
    if (one == kind) return true;
  }
  return false;
}

}  // namespace passo
