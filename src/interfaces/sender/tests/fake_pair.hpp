// A sender and a board with any of the firmwares, connected to each other in virtual time.
#pragma once

#include <functional>
#include <utility>

#include "kit/firmware_fakes.hpp"

#include "passo/sender/grbl_sender.hpp"

namespace passo {

struct FakePair {
  explicit FakePair(test::FirmwareTraits traits) : board(std::move(traits)) {}

  bool play(const std::function<bool()>& is_so, const std::function<void()>& each = {}, Seconds most = Seconds(600)) {
    for (const Seconds end = now + most; now < end && !is_so();) {
      board.receive(sender.take_bytes(now));
      board.run(0.005);
      now += Seconds(0.005);
      sender.receive(board.take_output(), now);
      if (each) each();
    }
    return is_so();
  }
  bool greet() {
    board.restart();
    return play([&] { return sender.ready() || sender.fault(); }) && sender.ready();
  }

  Seconds now{0};
  test::FirmwareFake board;
  GrblSender sender{Seconds(0)};
};

}  // namespace passo
