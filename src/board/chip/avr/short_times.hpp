// RingTimes where an entry of the ring has only the low byte of its time: the step timer is timer 0, which wraps every
// 256 ticks. Where events are further apart, entries in between toggle nothing: waits. long_times.hpp is the
// counterpart with the same functions.
//
// A wait is at most 256 ticks after the entry before it, and the event at least 129 after the last wait, so that the
// interrupt is never late for it. Timer 1 runs in parallel with timer 0 and gives the main loop the time in 16 bits.
// Between two pieces of work all times are known in 16 bits: expansion.time is that of the last event made, or during a
// wait that of the next event.
#pragma once

#include "event_ring.hpp"
#include "registers.hpp"
#include "serial_line.hpp"
#include "step_interrupt.hpp"

namespace passo::chip {

class RingTimes {
 public:
  // During playback the interrupt comes often enough to read every byte from the serial port.
  static constexpr bool are_short = true;

  static void prepare() {
    Tccr0a::write(0);
    Tccr0b::write(0);
    Tccr1a::write(0);
    Tccr1b::write(0);
    Tcnt0::write(0);
    Tcnt1h::write(0);
    Tcnt1l::write(0);
    Tccr1b::write(1);
    Tccr0b::write(1);
  }
  static void restart() {
    expansion.is_amid = 0;
    since_wait_ = since_count_ = 255;
    reach_ = Reach::far;
  }
  static void disable() { Timsk0::write(0); }
  static void enable(uint8_t index) {
    Ocr0a::write(*time_low_of(index));
    Tifr0::write(compare_match_a);
    running = 1;
    Timsk0::write(compare_match_a);
  }

  struct Last {
    uint16_t entry;
    void record() { entry = made_; }
    bool is_played(uint8_t waiting, uint16_t /*since*/) const {
      return waiting <= static_cast<uint16_t>(made_ - entry);
    }
  };

  // Call after a segment was loaded.
  static void load() { reach_ = reach(); }
  // Entries far apart last long enough to cover the call overhead.
  static uint8_t way_in() { return reach_ == Reach::near ? way_in_events : uint8_t{0}; }
  // Whether making an entry takes about as long as playing it at the shortest interval: 100 and 129 cycles.
  static bool are_slow() { return reach_ == Reach::far; }
  // Returns the number of entries to make at once when few or none are waiting.
  static uint8_t few() { return reach_ == Reach::near ? few_events : most_waits_at_once; }
  // The ring's size limits the time.
  static uint8_t most_ahead(uint16_t /*ticks*/) { return most_events; }
  // Returns the smallest room in the ring for which making events is worth the work. With events far apart, the loop
  // may do other work for long, and the remaining entries must last while a status is answered.
  static uint8_t least_room(uint8_t /*most_ahead*/) {
    if (reach_ == Reach::near) return most_events / 2;
    return reach_ == Reach::middle ? most_events / 3 : most_events / 6;
  }
  // Whether `events` events fit into `room` entries.
  static bool fit(uint8_t events, uint8_t room) { return room >> (reach_ == Reach::near ? 0 : 1) >= events; }
  // Making many events far apart in one batch would delay reading the serial port too long.
  static uint8_t at_once(uint8_t count) {
    return line_is_watched != 0 || count <= most_waits_at_once || reach_ == Reach::near ? count : most_waits_at_once;
  }
  // The expander wraps at the ring's end.
  static uint8_t before_the_end(uint8_t /*first*/, uint8_t count) { return count; }
  static uint8_t make(uint8_t count, uint8_t& left) {
    if (reach_ != Reach::near) return make_slowly(count, left);
    if (count > left) count = left;
    left = static_cast<uint8_t>(left - count);
    make_near(count);
    return count;
  }
  // Whether no event needs a wait before it.
  static bool are_near() { return reach_ == Reach::near; }
  static void make_near(uint8_t count) {
    expand(count);
    add(count);
    since_wait_ = no_more_than_255(since_wait_, count);
  }
  [[gnu::noinline]] static uint8_t make_slowly(uint8_t count, uint8_t& left) {
    since_wait_ = 0;
    const bool begins = expansion.is_amid == 0;
    if (reach_ == Reach::far && begins) reach_ = reach();
    if (reach_ != Reach::far && begins && count > 1) {
      uint8_t events = count / 2;
      if (events > left) events = left;
      left = static_cast<uint8_t>(left - events);
      const uint8_t behind = expand_with_waits(events);
      count = static_cast<uint8_t>(behind - static_cast<uint8_t>(expansion.address)) / sizeof(EventEntry);
    } else {
      expansion.events = left;
      count = static_cast<uint8_t>(count - expand_slowly(count));
      left = expansion.events;
    }
    add(count);
    return count;
  }
  // Walks through the ring if there are waits: from the entry at which the last walk ended, if it is still in the ring.
  [[gnu::noinline]] static uint16_t played(uint8_t from, uint8_t entries, uint16_t made) {
    uint16_t played;
    if (entries <= since_wait_) {
      played = static_cast<uint16_t>(made - entries);
    } else if (since_count_ < ring_mask && since_count_ >= entries) {
      const uint8_t back = static_cast<uint8_t>(since_count_ - entries);
      played = static_cast<uint16_t>(counted_ + events(static_cast<uint8_t>(from - back), back));
    } else {
      played = static_cast<uint16_t>(made - events(from, entries));
    }
    counted_ = played;
    since_count_ = entries;
    return played;
  }
  static uint8_t finished(uint8_t written, bool turns) {
    if ((written & first_waits) != 0) return turns ? flag_special | first_waits : flag_stop;
    const uint8_t plain = static_cast<uint8_t>(written & ~(flag_special | flag_stop));
    return turns ? static_cast<uint8_t>(plain | flag_special) : plain;
  }
  static uint8_t toggles_of(uint8_t flagged) { return static_cast<uint8_t>(flagged & ~(flag_special | first_waits)); }

  // Walks through the ring; the interrupt must be stopped.
  [[gnu::noinline]] static uint16_t due(uint8_t first, uint8_t head) {
    uint16_t time = static_cast<uint16_t>(expansion.time >> 16);
    if (expansion.is_amid != 0) time = static_cast<uint16_t>(time - (expansion.waits << 8) - expansion.rest - 129);
    for (;;) {
      head = (head - 1) & ring_mask;
      if (head == first) return time;
      time = static_cast<uint16_t>(time - gap(head));
      SerialLine::breathe();
    }
  }
  static uint16_t gap(uint8_t index) {
    const uint8_t ticks =
        static_cast<uint8_t>(*time_low_of(index) - *time_low_of(static_cast<uint8_t>((index - 1) & ring_mask)));
    return ticks == 0 ? 256 : ticks;
  }
  static bool is_only_a_wait(uint8_t index) { return is_wait(flagged_byte(index)); }
  static void place(uint8_t index, uint16_t time) {
    *time_low_of(index) = static_cast<uint8_t>(time);
    add(1);
  }
  static void delay(uint8_t index, uint16_t ticks) {
    *time_low_of(index) = static_cast<uint8_t>(*time_low_of(index) + ticks);
  }
  // An event made during a wait is timed from the last entry.
  static void delay_next(uint16_t ticks) { expansion.at = static_cast<uint8_t>(expansion.at + ticks); }

 private:
  static bool is_wait(uint8_t flagged) {
    if ((flagged & flag_special) != 0) return (flagged & first_waits) != 0;
    return (flagged & flag_stop) != 0;
  }
  static uint8_t no_more_than_255(uint8_t a, uint8_t b) {
    return a > 255 - b ? uint8_t{255} : static_cast<uint8_t>(a + b);
  }
  static void add(uint8_t entries) {
    made_ = static_cast<uint16_t>(made_ + entries);
    since_count_ = no_more_than_255(since_count_, entries);
  }
  // Returns the number of events among `entries` entries from this one on, without the waits: 12 cycles per entry. The
  // interrupt may be stopped, so the serial port is read during the loop.
  static uint8_t events(uint8_t from, uint8_t entries) {
    constexpr uint8_t piece = 24;
    uint8_t events = 0;
    while (entries != 0) {
      const uint8_t some = entries < piece ? entries : piece;
      events = events_among(from, some, events);
      from = static_cast<uint8_t>(from + some);
      entries = static_cast<uint8_t>(entries - some);
      SerialLine::breathe();
    }
    return events;
  }
  // Adds the events among them to `events`. At least one entry.
  static uint8_t events_among(uint8_t from, uint8_t entries, uint8_t events) {
    uint16_t at = toggles_address(from);
    asm volatile(R"(
      1:  ldi r31, 0x01             ; 1   the ring is a page
          ld r25, Z+                ; 2
          inc r30                   ; 1
          sbrc r25, %[special]      ; 2
          rjmp 3f
          sbrs r25, %[stop]         ; 2
      2:  inc %[events]             ; 1
      4:  dec %[entries]            ; 1
          brne 1b                   ; 2
          rjmp 5f
      3:  sbrs r25, %[first_waits]
          rjmp 2b
          rjmp 4b
      5:
    )"
                 : [events] "+r"(events), [entries] "+r"(entries), "+z"(at)
                 : [special] "n"(0), [stop] "n"(1), [first_waits] "n"(7)
                 : "r25", "memory");
    return events;
  }
  static_assert(flag_special == 1 << 0 && flag_stop == 1 << 1 && first_waits == 1 << 7 && ring_address == 0x100);
  // The upper limit of the next 255 intervals: 256 ticks, 512 ticks, or none of these.
  enum class Reach : uint8_t { near, middle, far };
  [[gnu::noinline]] static Reach reach() {
    const int32_t change = expansion.change;
    if (change > 0xffff) return Reach::far;
    uint32_t longest = expansion.interval;
    if (change > 0) longest += static_cast<uint32_t>(static_cast<uint16_t>(change)) << 8;
    const uint8_t ticks = static_cast<uint8_t>(longest >> 24);
    return ticks == 0 ? Reach::near : ticks == 1 ? Reach::middle : Reach::far;
  }

  static constexpr uint8_t few_events = 8;
  static constexpr uint8_t most_waits_at_once = 4;

  static inline Reach reach_ = Reach::far;
  static inline uint16_t made_ = 0;          // total number of entries made
  static inline uint8_t since_wait_ = 255;   // entries made since one that may be a wait; 255: at least 255
  static inline uint8_t since_count_ = 255;  // entries made since the one up to which events were counted, and
  static inline uint16_t counted_ = 0;       // their number of events
};

}  // namespace passo::chip
