// A sender and a machine connected to each other, in virtual time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "kit/strict_grbl.hpp"

#include "passo/sender/grbl_sender.hpp"

namespace passo {

struct GrblPair {
  explicit GrblPair(std::size_t bytes = 128) : machine(bytes) { machine.block_time = 0.05; }

  // Runs until is_so() returns true, or for a minute. `each` is called at each step.
  bool play(const std::function<bool()>& is_so, const std::function<void()>& each = {}) {
    return play_for(Seconds(60), is_so, each);
  }
  bool play_for(Seconds most, const std::function<bool()>& is_so, const std::function<void()>& each = {}) {
    for (const Seconds end = now + most; now < end;) {
      if (is_so()) return true;
      if (each) each();
      const std::string bytes = sender.take_bytes(now);
      machine.receive(between ? between(true, bytes) : bytes);
      machine.run(0.005);
      now += Seconds(0.005);
      const std::string replies = machine.take_output();
      sender.receive(between ? between(false, replies) : replies, now);
    }
    return is_so();
  }
  bool greet() {
    return play([&] { return sender.ready() || sender.fault(); }) && sender.ready();
  }
  // Streams moves of one millimetre each: lines 1 to `count`.
  bool stream(std::uint32_t count, const std::function<void()>& each = {}) {
    std::uint32_t next = 1;
    const auto feed = [&] {
      while (sender.wants_lines() && next <= count && !sender.fault()) {
        sender.add(fmt::format("G1F600X{}Y0Z0", next), next);
        ++next;
      }
      if (each) each();
    };
    feed();
    return play_for(
        Seconds(3600), [&] { return (next > count && sender.at_rest()) || sender.stopped(); }, feed);
  }

  Seconds now{0};
  // What the line makes of the bytes to the board, or from it.
  std::function<std::string(bool, const std::string&)> between = {};
  StrictGrbl machine;
  GrblSender sender{Seconds(0)};
};

}  // namespace passo
