// BoardIdentity: what a board knows of itself, and the arithmetic of its highest rate. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/message.hpp"

namespace passo {

struct BoardIdentity {
  uint8_t motors = 0;  // the most that it can turn
  uint32_t clock = 0;  // ticks a second
  ResetCause reset = ResetCause::power_on;
  uint32_t shortest_interval = 0;  // of a segment that it takes; shortest_interval() tells which goes with a rate
  About about = {};
  uint8_t places = 0xFF;  // for items, where it is to have fewer than there is memory for
};

// The interval at this many events a second, and a whole tick less: the host fits its segments that closely. 0: any.
constexpr uint32_t shortest_interval(uint32_t clock, uint32_t highest_event_rate) {
  if (highest_event_rate == 0) return 0;
  const uint64_t interval = (uint64_t{clock} << 16) / highest_event_rate;
  if (interval < uint64_t{whole_tick}) return 0;
  return static_cast<uint32_t>(interval < largest_interval ? interval : largest_interval) -
         static_cast<uint32_t>(whole_tick);
}

// change * times <= room, bit by bit: the product has 39 bits.
template <class Pause>
[[gnu::noinline]] bool product_fits(uint32_t change, uint16_t times, uint32_t room) {
  while (true) {
    if ((times & 1U) != 0) {
      if (change > room) return false;
      room -= change;
    }
    times >>= 1;
    if (times == 0) return true;
    if (change >> 31 != 0) return false;
    change <<= 1;
    Pause{}();
  }
}

// Its first interval and its last one, and so all between.
template <class Pause, uint8_t room_for>
[[gnu::noinline]] bool is_slow_enough(const SegmentFor<room_for>& segment, uint32_t shortest) {
  const uint32_t interval = segment.interval;
  if (interval < shortest) return false;
  if (segment.change == 0) return true;
  const bool faster = segment.change < 0;
  const uint32_t given = static_cast<uint32_t>(segment.change);
  const uint32_t change = faster ? 0 - given : given;  // a coarse change has no opposite in 32 bits with a sign
  const uint32_t room = faster ? interval - shortest : largest_interval - interval;
  // Most segments are far from it, and so need no product.
  const uint16_t times = static_cast<uint16_t>(segment.events - 1);
  return (times <= 0xFF && change >> 24 == 0 && change << 8 <= room) || product_fits<Pause>(change, times, room);
}

}  // namespace passo
