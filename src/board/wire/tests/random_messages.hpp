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
  // Makes sync bytes, and the distances that replace them, far more frequent than by chance.
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
    segment.flips = motors > most_motors_beside_bend ? byte() : byte() & 0x0F;
    segment.interval = static_cast<std::uint32_t>(word()) << 16 | word();
    segment.change = static_cast<std::int32_t>(below(2 * fine_change + 1)) - fine_change;
    if (below(4) == 0) segment.change *= coarse_change;
    for (unsigned m = 0; m < motors; ++m) segment.increments[m] = word();
    segment.form = static_cast<std::uint8_t>(below(16));
    const unsigned lender = below(motors);
    const bool two = bends_two(segment, static_cast<std::uint8_t>(lender));
    if (two && motors < least_motors_to_bend_two) return segment;
    segment.bend = static_cast<std::uint8_t>(below(two ? largest_scale + 1U : motors) | lender << 4);
    return segment;
  }

  std::int32_t position() { return static_cast<std::int32_t>(static_cast<std::uint32_t>(word()) << 16 | word()); }
  BoardStatus status() {
    BoardStatus status{.session = word(),
                       .executed = word(),
                       .taken = byte(),
                       .free = byte(),
                       .event = byte(),
                       .state = byte(),
                       .reset = static_cast<ResetCause>(byte()),
                       .motors = byte(),
                       .inputs = word(),
                       .answers = byte()};
    for (std::int32_t& place : status.positions) place = position();
    return status;
  }
  Replace replace() {
    Replace replace{.after = word(), .count = byte()};
    replace.sums.first = word();
    replace.sums.second = word();
    return replace;
  }
  Captured captured() {
    Captured captured{.input = word(), .item = byte(), .event = byte()};
    for (std::int32_t& place : captured.positions) place = position();
    return captured;
  }
  Turned turned() {
    Turned turned{
        .progress = {.executed = word(), .taken = byte(), .free = byte()}, .event = word(), .answers = byte()};
    turned.spindle.count = static_cast<std::uint32_t>(position());
    turned.spindle.tick = static_cast<std::uint32_t>(position());
    turned.spindle.at_index = static_cast<std::uint32_t>(position());
    turned.spindle.indexes = byte();
    return turned;
  }
  About about() {
    About about{.firmware = word(),
                .highest_event_rate = static_cast<std::uint32_t>(position()),
                .baud = static_cast<std::uint32_t>(position())};
    for (char& letter : about.name) letter = static_cast<char>(byte());
    return about;
  }

  // Returns a frame of a random type.
  Bytes frame(std::uint8_t motors) {
    std::array<std::uint8_t, largest_frame> frame{};
    std::uint8_t size = 0;
    const std::uint8_t sequence = byte();
    switch (below(18)) {
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
      case 3: {
        const Credit credit{.executed = word(), .taken = byte(), .free = byte()};
        size = encode(credit, sequence, frame.data());
        break;
      }
      case 4: {
        const ErrorReport error{.reason = static_cast<WireError>(byte()), .expected = byte()};
        size = encode(error, sequence, frame.data());
        break;
      }
      case 5: size = encode(Session{.number = word()}, sequence, frame.data()); break;
      case 6: size = encode(replace(), sequence, frame.data()); break;
      case 7: {
        const Ask ask{.version = byte(), .motors = byte(), .question = static_cast<Question>(byte()), .limit = byte()};
        size = encode(ask, sequence, frame.data());
        break;
      }
      case 8: size = encode(status(), motors, sequence, frame.data()); break;
      case 9: size = encode(captured(), motors, sequence, frame.data()); break;
      case 10: {
        const Fault fault{
            .reason = static_cast<FaultReason>(byte()), .inputs = word(), .event = byte(), .executed = word()};
        size = encode(fault, sequence, frame.data());
        break;
      }
      case 11: size = encode(about(), sequence, frame.data()); break;
      case 12: size = encode(turned(), sequence, frame.data()); break;
      case 13: {
        const PinSetup setup{.inputs = word(),
                             .steps = byte(),
                             .outputs = byte(),
                             .drivers_rest = byte(),
                             .timing = {.pulse = byte(), .set_up = byte(), .hold = byte(), .event_ticks = word()},
                             .alarms = word(),
                             .filter = byte()};
        size = encode(setup, sequence, frame.data());
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
