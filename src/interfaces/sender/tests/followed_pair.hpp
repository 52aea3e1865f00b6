// A sender that follows a machine which plans its motion, over a line of 115,200 baud.
#pragma once

#include <string>
#include <vector>

#include "grbl_pair.hpp"

namespace passo {

struct FollowedPair : GrblPair {
  explicit FollowedPair(double acceleration = 500, double rate = 6000) {
    machine.block_time = 0;
    machine.bytes_per_second = 11520;
    for (const int axis : {0, 1, 2}) {
      machine.put(110 + axis, rate);
      machine.put(120 + axis, acceleration);
    }
  }
  bool begin(Seconds ahead = GrblSender::default_ahead) {
    if (!greet()) return false;
    sender.follow({}, ahead);
    begun = now;
    return true;
  }
  // Streams lines, numbered from 1, until all is done or the sender has stopped.
  bool run(const std::vector<std::string>& lines, const std::function<void()>& each = {},
           Seconds most = Seconds(7200)) {
    std::size_t next = 0;
    const auto feed = [&] {
      while (sender.wants_lines() && next < lines.size() && !sender.fault()) {
        sender.add(lines[next], static_cast<std::uint32_t>(next + 1));
        ++next;
      }
      if (each) each();
    };
    feed();
    return play_for(
        most, [&] { return (next == lines.size() && sender.at_rest()) || sender.stopped(); }, feed);
  }
  // How long the machine goes on if it hears nothing more.
  double runs_on() {
    const double from = machine.now();
    while (machine.speed() > 0 && machine.now() < from + 60) machine.run(0.01);
    return machine.now() - from;
  }
  Seconds begun{0};
};

}  // namespace passo
