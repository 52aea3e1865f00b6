// HandwheelCount: what a board reports of the handwheel at its pins. It travels in a Turned message, whose fields for
// the spindle have other meanings then (docs/wire.md). Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/message.hpp"

namespace passo {

// The selectors of a handwheel. A set bit means that the input is connected to ground.
enum HandwheelSelector : uint8_t {
  handwheel_axis = 1,  // the first axis; the next three bits are the others
  handwheel_tenfold = 0x10,
  handwheel_hundredfold = 0x20,
};
inline constexpr uint8_t handwheel_axes = 4;

struct HandwheelCount {
  uint32_t count = 0;    // edges, forward minus back, modulo 2^32
  uint16_t jumps = 0;    // edges missed, modulo 65,536
  uint8_t selected = 0;  // bits: HandwheelSelector
};

constexpr SpindleCount to_fields(const HandwheelCount& wheel) {
  return {.count = wheel.count, .tick = 0, .at_index = wheel.jumps, .indexes = wheel.selected};
}
constexpr HandwheelCount handwheel_in(const Turned& turned) {
  return {.count = turned.spindle.count,
          .jumps = static_cast<uint16_t>(turned.spindle.at_index),
          .selected = turned.spindle.indexes};
}

}  // namespace passo
