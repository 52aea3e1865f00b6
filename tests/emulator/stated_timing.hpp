// stated_timing: what an emulated board answers to a host whose drivers need such pulses.
#pragma once

#include <optional>

#include "passo/emulator/emulated_board.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo::test {

// The board keeps the setup for the next hello. Empty: it does not answer.
inline std::optional<StepTiming> stated_timing(EmulatedBoard& board, const StepTiming& wanted) {
  constexpr Seconds to_start{0.5};
  constexpr Seconds to_answer{0.1};
  static_cast<void>(board.run(to_start));
  std::uint8_t frame[largest_frame];
  board.receive({frame, encode(PinSetup{.timing = wanted}, 0, frame)});
  Decoder decoder;
  while (board.run(to_answer)) {
    for (const std::uint8_t byte : board.replies()) {
      if (decoder.feed(byte) != Decoded::frame || decoder.frame().type != MessageType::pin_setup) continue;
      PinSetup setup;
      decode(decoder.frame(), setup);
      return setup.timing;
    }
  }
  return {};
}

}  // namespace passo::test
