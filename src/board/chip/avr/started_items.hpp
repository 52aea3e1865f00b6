// StartedItems: the items that the player has begun and whose steps are not counted yet, with the number of steps in
// each.
//
// The list is short, the oldest item first. The step accumulators at the start of the oldest item are kept, so the
// steps in any number of its events can be computed without the events themselves.
#pragma once

#include "event_ring.hpp"
#include "products.hpp"
#include "serial_line.hpp"
#include "step_interrupt.hpp"
#if defined PASSO_WINDINGS || defined __AVR_ATmega2560__
#include "long_times.hpp"
#else
#include "short_times.hpp"
#endif

#include "passo/wire/board_segment.hpp"

namespace passo::chip {

class StartedItems {
 public:
  static void clear() {
    is_over_ = false;
    oldest_ = count_ = 0;
    for (uint16_t& accumulator : at_start_) accumulator = 0x8000;
  }
  static uint8_t count() { return count_; }

  // `end`: the total number of events made up to the last event of this item.
  [[gnu::noinline]] static void add(const SegmentFor<pins.motors>& segment, uint16_t end) {
    ++count_;
    const uint8_t place = newest();
    ends_[place] = end;
    Item& item = items_[place];
    item.events = segment.events;
    item.directions = segment.directions & motors_mask;
    item.flips = segment.flips & motors_mask;
    for (uint8_t m = 0; m < motors(); ++m) item.increments[m] = segment.increments[m];
  }
  static void add_outputs(uint16_t end) {
    ++count_;
    const uint8_t place = newest();
    ends_[place] = end;
    lasts_[place].record();
    items_[place].events = 0;
  }
  // The last event of the newest item was made just now.
  static void record_last() { lasts_[newest()].record(); }

  // Returns the number of events of the oldest item.
  static uint8_t events() { return items_[oldest_].events; }
  static uint16_t end() { return ends_[oldest_]; }
  static const RingTimes::Last& last() { return lasts_[oldest_]; }
  // Whether the oldest item is known to be done. Its steps are then read once, and the item is dropped.
  static bool is_over() { return is_over_; }
  static bool set_over(bool over) { return is_over_ = over; }
  static void forget() {
    is_over_ = false;
    --count_;
    oldest_ = oldest_ == most_begun - 1 ? uint8_t{0} : static_cast<uint8_t>(oldest_ + 1);
  }

  // Returns the signed number of steps of a motor in the first `events` events.
  [[gnu::noinline]] static int16_t steps(uint8_t events, uint8_t motor) {
    const Item& item = items_[oldest_];
    const uint8_t bit = static_cast<uint8_t>(1U << motor);
    const bool is_flipped = (item.flips & bit) != 0;
    const bool goes_down = (item.directions & bit) != 0;
    uint16_t accumulator = at_start_[motor];
    int16_t steps = carries(accumulator, item.increments[motor], events);
    if (is_over_) at_start_[motor] = accumulator;
    SerialLine::breathe();
    if (is_flipped) steps = static_cast<int16_t>(events - steps);
    return goes_down ? static_cast<int16_t>(-steps) : steps;
  }
  // Adds the steps of all motors to their positions. Every part is counted this way; all motors in one pass take half
  // as long. With the Mega's interrupt there are too few registers for that.
  [[gnu::noinline]] static void add_steps(uint8_t events, int32_t* positions) {
    if (step_port_count > 1) {
      for (uint8_t m = 0; m < motors(); ++m) positions[m] += steps(events, m);
      return;
    }
    const Item& item = items_[oldest_];
    const uint16_t* increments = item.increments;
    uint16_t* starts = at_start_;
    uint8_t flips = item.flips;
    uint8_t directions = item.directions;
    for (uint8_t left = motors(); left != 0; --left) {
      uint8_t steps = carries(*starts, *increments, events);
      if ((flips & 1) != 0) steps = static_cast<uint8_t>(events - steps);
      *positions += (directions & 1) != 0 ? -int32_t{steps} : int32_t{steps};
      SerialLine::breathe();
      flips >>= 1;
      directions >>= 1;
      ++starts;
      ++increments;
      ++positions;
    }
  }

  // On the Uno, saving the loop matters more than saving a motor.
  static uint8_t motors() { return pins.motors > 3 ? expansion.motors : pins.motors; }

 private:
  static constexpr uint8_t motors_mask = (1U << pins.motors) - 1;
  static constexpr unsigned bits_of_motors = pins.motors > 4 ? 8 : 4;
  struct Item {
    uint8_t events;  // 0: outputs
    uint8_t directions : bits_of_motors;
    uint8_t flips : bits_of_motors;
    uint16_t increments[pins.motors];
  };

  static uint8_t newest() {
    const uint8_t place = static_cast<uint8_t>(oldest_ + count_ - 1);
    return place >= most_begun ? static_cast<uint8_t>(place - most_begun) : place;
  }

  static inline uint8_t oldest_ = 0;  // index of the oldest item
  static inline uint8_t count_ = 0;
  static inline bool is_over_ = false;
  static inline Item items_[most_begun];
  static inline uint16_t ends_[most_begun];
  static inline RingTimes::Last lasts_[most_begun];
  static inline uint16_t at_start_[pins.motors] = {};  // the accumulators at the start of the oldest one
};

}  // namespace passo::chip
