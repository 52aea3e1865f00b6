// BoardIdentity: a board's own properties, and the calculation of its maximum event rate. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/message.hpp"
#include "passo/wire/segment_parts.hpp"

namespace passo {

// Whether change * times <= room, computed bit by bit: the product has 39 bits.
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

struct BoardIdentity {
  uint8_t motors = 0;  // the largest number of motors that it can drive
  uint32_t clock = 0;  // in Hz
  ResetCause reset = ResetCause::power_on;
  uint32_t shortest_interval = 0;  // the shortest interval of an accepted segment; shortest_interval() computes it from
                                   // a rate
  About about = {};
  uint8_t places = 0xFF;  // number of places for items, if fewer than fit into memory

  // Whether the segment has events, uses only motors that exist, and is slow enough at its first and last intervals,
  // and so at all intervals in between. For a root segment only the first interval is checked: each part is checked
  // when it is due.
  template <class Pause, class Segment>
  [[gnu::noinline]] bool can_play(const Segment& segment, uint8_t motors_there) const {
    const uint8_t used = segment.directions | segment.flips;
    if (segment.events == 0 || used >> motors_there != 0) return false;
    const uint32_t interval = segment.interval;
    if (interval < shortest_interval) return false;
    if (segment.change == 0 || is_root(segment.form)) return true;
    const bool faster = segment.change < 0;
    const uint32_t given = static_cast<uint32_t>(segment.change);
    const uint32_t change = faster ? 0 - given : given;  // a coarse change may have no negative in signed 32 bits
    const uint32_t room = faster ? interval - shortest_interval : largest_interval - interval;
    // Most segments are far from the limit and need no product.
    const uint16_t times = static_cast<uint16_t>(segment.events - 1);
    return (times <= 0xFF && change >> 24 == 0 && change << 8 <= room) || product_fits<Pause>(change, times, room);
  }
  // Limits a part that is too fast, which only a faulty host sends, to the highest allowed speed. Most parts
  // decelerate.
  template <class Pause, class Segment>
  [[gnu::noinline]] void keep_playable(Segment& part, uint8_t motors_there) const {
    const bool brakes = part.change >= 0 && part.change <= 0xffff && part.interval >> 31 == 0;
    if (brakes && part.interval >= shortest_interval) return;
    // A part has 255 events at most. Nearly all accelerating parts return here.
    const uint32_t faster = 0 - static_cast<uint32_t>(part.change);
    if (part.change < 0 && faster >> 24 == 0 && part.interval >= shortest_interval &&
        faster << 8 <= part.interval - shortest_interval) {
      return;
    }
    if (can_play<Pause>(part, motors_there)) return;
    if (part.interval < shortest_interval) part.interval = shortest_interval;
    part.change = 0;
  }
};

// Returns the interval for this event rate, less one whole tick, because the host fits its segments that closely. 0: no
// limit.
constexpr uint32_t shortest_interval(uint32_t clock, uint32_t highest_event_rate) {
  if (highest_event_rate == 0) return 0;
  const uint64_t interval = (uint64_t{clock} << 16) / highest_event_rate;
  if (interval < uint64_t{whole_tick}) return 0;
  return static_cast<uint32_t>(interval < largest_interval ? interval : largest_interval) -
         static_cast<uint32_t>(whole_tick);
}

}  // namespace passo
