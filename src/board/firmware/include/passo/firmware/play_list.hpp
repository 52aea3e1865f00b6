// PlayList: the items that a board holds, in the order of execution. It also collects the items of a queue update,
// which replace its stop ramp.
//
// Items lie in slots, and each slot has the index of the next one: an item is written once and never moved. A
// replacement is gathered in separate slots. When it is complete, one link changes from the old stop ramp to the new
// items. An incomplete replacement changes nothing. Chains of slots are freed as a whole.
//
//     front -> item -> item k -> tail -> tail          before: the tail is the stop ramp
//                        |
//                        +-> staged -> staged -> …     after the switch; the old tail's slots are free
//
// Only the main loop uses it, even where the timer is an interrupt. Portable: no heap. Finding item k means walking
// through the list.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/encoder.hpp"

namespace passo {

// An item in as few bytes as possible, for boards with little memory: 15 bytes, and two for each of its motors.
template <uint8_t motors>
struct BoardItemSlot {
  uint16_t number = 0;
  uint8_t next = 0;
  SegmentFor<motors> segment;  // a segment without events means outputs

  bool is_segment() const { return segment.events != 0; }
  void keep(const BoardOutputs& outputs) {
    segment.events = 0;
    segment.directions = outputs.switches & 0x0F;
    segment.interval = outputs.spindle_rpm;
  }
  BoardOutputs outputs() const {
    return {.switches = segment.directions, .spindle_rpm = static_cast<uint16_t>(segment.interval)};
  }
};

// Pause{}() is called during long work.
template <size_t slot_count, uint8_t motors = max_motors, class Pause = NoPause>
class PlayList {
  static constexpr uint8_t none = 0xFF;
  static_assert(slot_count > 0 && slot_count < none);

 public:
  using Slot = BoardItemSlot<motors>;

  PlayList() { clear(); }

  // Empties the list, and limits it to `places` items.
  void clear(uint8_t places = slot_count) {
    unused_ = none;
    for (uint8_t i = places; i-- != 0;) {
      slots_[i].next = unused_;
      unused_ = i;
      Pause{}();
    }
    free_ = places;
    front_ = last_ = none;
    size_ = 0;
    staged_ = {};
  }

  uint8_t free() const { return free_; }
  bool empty() const { return front_ == none; }
  const Slot& front() const { return slots_[front_]; }
  // Returns the item at index `place` from the front, not counting gathered items. Walks through the list.
  Slot& at(uint8_t place) {
    uint8_t slot = front_;
    for (; place != 0; --place) slot = slots_[slot].next;
    return slots_[slot];
  }
  uint8_t size() const { return size_; }
  void pop() {
    const uint8_t slot = front_;
    --size_;
    front_ = slots_[slot].next;
    if (front_ == none) last_ = none;
    release_slots(slot, slot, 1);
  }

  // Returns the slot for the next item; its `next` must not be written. Call only while free() > 0.
  Slot& space() { return slots_[unused_]; }
  // Adds that item: to the replacement if one is being gathered, otherwise after the last item.
  void append() {
    const uint8_t slot = unused_;
    unused_ = slots_[slot].next;
    --free_;
    slots_[slot].next = none;
    if (gathering()) {
      link(staged_.front, staged_.last, slot);
      --staged_.missing;
    } else {
      link(front_, last_, slot);
      ++size_;
    }
  }

  // Starts a replacement: the next `count` items replace everything after item `after`. Drops an incomplete
  // replacement.
  void begin_replacement(uint16_t after, uint8_t count) {
    drop_replacement();
    staged_ = {.after = after, .count = count, .missing = count};
  }
  // Drops an incomplete queue update.
  void drop_replacement() {
    if (staged_.front != none) {
      release_slots(staged_.front, staged_.last, static_cast<uint8_t>(staged_.count - staged_.missing));
    }
    staged_ = {};
  }
  bool gathering() const { return staged_.missing > 0; }
  // True when all items have arrived; then call complete().
  bool gathered() const { return staged_.front != none && staged_.missing == 0; }
  // Puts the replacement in place. `executed` is the number of the last item that was popped. The first `begun` items
  // are being played or prepared for the timer, and stay. Returns false and changes nothing if an item after `after`
  // has begun. The queue ends in a stop: if nothing is replaced, `from_rest` becomes the low byte of the number of the
  // first new item. This is the longest operation, so Pause{}() is called between its parts.
  bool complete(uint16_t executed, uint8_t begun, uint8_t& from_rest) {
    uint8_t slot = front_;
    uint8_t place = 1;
    for (; slot != none && slots_[slot].number != staged_.after; slot = slots_[slot].next) {
      ++place;
      Pause{}();
    }
    const bool behind_all = slot == none && begun == 0 && executed == staged_.after;
    Pause{}();
    const bool in_time = behind_all || (slot != none && place >= begun);
    if (!in_time) {
      drop_replacement();
      return false;
    }
    const uint8_t kept = slot == none ? uint8_t{0} : place;
    uint8_t& end = slot == none ? front_ : slots_[slot].next;
    if (end != none) {
      release_slots(end, last_, static_cast<uint8_t>(size_ - kept));
    } else {
      from_rest = static_cast<uint8_t>(slots_[staged_.front].number);
    }
    end = staged_.front;
    last_ = staged_.last;
    size_ = static_cast<uint8_t>(kept + staged_.count);
    staged_ = {};
    return true;
  }

 private:
  struct Replacement {
    uint16_t after = 0;
    uint8_t count = 0;
    uint8_t missing = 0;
    uint8_t front = none;
    uint8_t last = none;
  };

  void link(uint8_t& front, uint8_t& last, uint8_t slot) {
    if (front == none) {
      front = slot;
    } else {
      slots_[last].next = slot;
    }
    last = slot;
  }
  // Frees a chain of `count` slots.
  void release_slots(uint8_t first, uint8_t last, uint8_t count) {
    slots_[last].next = unused_;
    unused_ = first;
    free_ = static_cast<uint8_t>(free_ + count);
  }
  Slot slots_[slot_count];
  uint8_t front_ = none;
  uint8_t last_ = none;
  uint8_t unused_ = none;  // the first free slot
  uint8_t free_ = 0;
  uint8_t size_ = 0;  // not counting the replacement
  Replacement staged_;
};

}  // namespace passo
