// Random messages for the wire's tests, and the bytes of their frames.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "kit/seed.hpp"

#include "passo/wire/message.hpp"

namespace passo {

using Bytes = std::vector<std::uint8_t>;

class RandomMessages {
 public:
  explicit RandomMessages(std::uint64_t seed) : random_(seed) {}

  unsigned below(unsigned limit) { return std::uniform_int_distribution<unsigned>(0, limit - 1)(random_); }
  // Sync bytes, and the distances that stand for them, come far more often than by chance.
  std::uint8_t byte() {
    switch (below(4)) {
      case 0: return sync_byte;
      case 1: return static_cast<std::uint8_t>(below(32));
      default: return static_cast<std::uint8_t>(below(256));
    }
  }
  std::uint16_t word() { return static_cast<std::uint16_t>(byte() | byte() << 8); }

  BoardSegment segment(std::uint8_t motors) {
    BoardSegment segment;
    segment.events = byte();
    segment.directions = byte();
    segment.flips = byte();
    segment.interval = static_cast<std::uint32_t>(word()) << 16 | word();
    segment.change = static_cast<std::int32_t>(below(2 * largest_change + 1)) - largest_change;
    for (unsigned m = 0; m < motors; ++m) segment.increments[m] = word();
    return segment;
  }

  // A frame of any kind.
  Bytes frame(std::uint8_t motors) {
    std::array<std::uint8_t, largest_frame> frame{};
    std::uint8_t size = 0;
    const std::uint8_t sequence = byte();
    switch (below(10)) {
      case 0: size = encode(Hello{.version = byte(), .motors = byte()}, sequence, frame.data()); break;
      case 1: size = encode(BoardOutputs{.switches = byte(), .spindle_rpm = word()}, sequence, frame.data()); break;
      case 2: {
        const HelloReply reply{.version = byte(),
                               .motors = byte(),
                               .capacity = byte(),
                               .clock = static_cast<std::uint32_t>(word()) << 16 | word()};
        size = encode(reply, sequence, frame.data());
        break;
      }
      case 3: size = encode(Credit{.executed = byte(), .free = byte()}, sequence, frame.data()); break;
      case 4: {
        const ErrorReport error{.reason = static_cast<WireError>(byte()), .expected = byte()};
        size = encode(error, sequence, frame.data());
        break;
      }
      case 5: size = encode(ProbeWatch{.until = static_cast<ProbeUntil>(byte())}, sequence, frame.data()); break;
      case 6: {
        ProbeReport report{.touched = below(2) == 1, .happened = below(2) == 1};
        for (std::int32_t& steps : report.steps) steps = static_cast<std::int32_t>(word() << 16U | word());
        size = encode(report, motors, sequence, frame.data());
        break;
      }
      default: size = encode(segment(motors), motors, sequence, frame.data()); break;
    }
    return {frame.begin(), frame.begin() + size};
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace passo
