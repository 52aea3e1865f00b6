// RingTimes where an entry of the ring has a time of 16 bits: the step timer is timer 1, and each entry is an event.
// short_times.hpp is the counterpart with the same functions.
#pragma once

#include "event_ring.hpp"
#include "registers.hpp"
#include "step_interrupt.hpp"

namespace passo::chip {

inline uint16_t time_of(uint8_t index) {
  return static_cast<uint16_t>(*time_high_of(index) << 8 | *time_low_of(index));
}
inline void set_time(uint8_t index, uint16_t time) {
  *time_high_of(index) = static_cast<uint8_t>(time >> 8);
  *time_low_of(index) = static_cast<uint8_t>(time);
}

class RingTimes {
 public:
  // The interrupt may be absent for a long time: then the main loop reads the serial port.
  static constexpr bool are_short = false;

  static void prepare() {
    Tccr1a::write(0);
    Tccr1b::write(1);
  }
  static void restart() {}
  static void disable() { Timsk1::write(0); }
  // Starts playing with this entry.
  static void enable(uint8_t index) {
    Ocr1ah::write(*time_high_of(index));
    Ocr1al::write(*time_low_of(index));
    Tifr1::write(compare_match_a);
    running = 1;
    Timsk1::write(compare_match_a);
  }

  // The ring position of an item's last event, if it must be kept in addition to the number of events.
  struct Last {
    void record() {}
    // `since`: events made after the item.
    bool is_played(uint8_t waiting, uint16_t since) const { return waiting <= since; }
  };

  static void load() {}
  static uint8_t way_in() { return way_in_events; }
  // Returns the number of entries to make at once when few or none are waiting.
  static uint8_t few() { return 8; }
  // Returns the number of events in two to three milliseconds (32,768 to 49,152 ticks), without a division. For a small
  // ring it is one to two milliseconds: winding events take long to make, and a switch would have to wait.
  static uint8_t most_ahead(uint16_t ticks) {
    constexpr bool is_large = ring_entries > 128;
    if (ticks < 256) return most_events;
    uint8_t most = is_large ? 128 : 64;
    for (; ticks >= 512; ticks >>= 1) most >>= 1;
    if (is_large && ticks >= 384) most = static_cast<uint8_t>(most - most / 4);
    if (most > most_events) return most_events;
    return most < 2 ? uint8_t{2} : most;
  }
  // Returns the smallest room in the ring for which making events is worth the work.
  static uint8_t least_room(uint8_t most_ahead) { return static_cast<uint8_t>(most_ahead / 8 * 3); }
  static bool fit(uint8_t events, uint8_t room) { return room >= events; }
  // Whether making an entry takes about as long as playing it at the shortest interval.
  static constexpr bool are_slow() { return false; }
  static constexpr bool are_near() { return true; }
  static void make_near(uint8_t count) { expand(count); }
  // Returns how many of `count` entries to make in one batch.
  static uint8_t at_once(uint8_t count) { return count; }
  // Limits `count`, because the expander stops at the ring's end.
  static uint8_t before_the_end(uint8_t first, uint8_t count) {
    const uint8_t behind_this = static_cast<uint8_t>(ring_mask - first);  // entries from here to the ring's end
    return count > behind_this ? static_cast<uint8_t>(behind_this + 1) : count;
  }
  // Makes `count` entries, each of which is an event.
  static uint8_t make(uint8_t count, uint8_t& left) {
    expand(count);
    left = static_cast<uint8_t>(left - count);
    return count;
  }
  // Returns the number of events played before this entry, with `entries` entries from there to the end of the ring.
  // `made`: total number of events made.
  static uint16_t played(uint8_t /*from*/, uint8_t entries, uint16_t made) {
    return static_cast<uint16_t>(made - entries);
  }
  // Returns the first byte of a finished entry, computed from the byte that the expander has written.
  static uint8_t finished(uint8_t written, bool turns) {
    const uint8_t plain = static_cast<uint8_t>(written & ~(flag_special | flag_stop));
    return turns ? static_cast<uint8_t>(plain | flag_special) : plain;
  }
  static uint8_t toggles_of(uint8_t flagged) { return static_cast<uint8_t>(flagged & ~flag_special); }

  // Returns the time of the entry at which the interrupt stopped; `head` is the entry after the last one.
  static uint16_t due(uint8_t first, uint8_t /*head*/) { return time_of(first); }
  // Returns the ticks since the preceding entry, which may have been played.
  static uint16_t gap(uint8_t index) {
    return static_cast<uint16_t>(time_of(index) - time_of(static_cast<uint8_t>((index - 1) & ring_mask)));
  }
  static bool is_only_a_wait(uint8_t /*index*/) { return false; }
  static void place(uint8_t index, uint16_t time) { set_time(index, time); }
  static void delay(uint8_t index, uint16_t ticks) { set_time(index, static_cast<uint16_t>(time_of(index) + ticks)); }
  static void delay_next(uint16_t /*ticks*/) {}
};

}  // namespace passo::chip
