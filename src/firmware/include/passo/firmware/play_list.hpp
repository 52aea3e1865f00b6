// PlayList: the items that a board holds, in the order in which it will play them; and beside it those that are to take
// the place of its tail.
//
// Items lie in slots, and each slot says which is next: an item is written once and never moved. A replacement gathers
// in slots of its own; when it is complete, one link changes, from the old tail to the new one. What is cut short
// changes nothing.
//
//     front -> item -> item k -> tail -> tail          before: the tail brings the motors to rest
//                        |
//                        +-> staged -> staged -> …     after the switch; the old tail's slots are free
//
// Only the main loop uses it, also where a timer is an interrupt. Portable: no heap; finding item k is a walk over the
// list.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/encoder.hpp"

namespace passo {

struct BoardItemSlot {
  uint16_t number = 0;
  bool is_segment = false;
  uint8_t next = 0;
  BoardSegment segment;
  BoardOutputs outputs;
};

template <size_t slot_count>
class PlayList {
  static constexpr uint8_t none = 0xFF;
  static_assert(slot_count > 0 && slot_count < none);

 public:
  PlayList() { clear(); }

  void clear() {
    for (uint8_t i = 0; i < slot_count; ++i) slots_[i].next = static_cast<uint8_t>(i + 1);
    slots_[slot_count - 1].next = none;
    unused_ = 0;
    free_ = slot_count;
    front_ = last_ = none;
    size_ = 0;
    staged_ = {};
  }

  uint8_t free() const { return free_; }
  bool empty() const { return front_ == none; }
  const BoardItemSlot& front() const { return slots_[front_]; }
  // Counted from the front, without what is gathered beside; a walk.
  const BoardItemSlot& at(uint8_t place) const {
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
    give_back(slot);
  }

  // Where the next item is to be written, all but its `next`: a copy is a lot of work for a small chip. Only while
  // free() > 0.
  BoardItemSlot& space() { return slots_[unused_]; }
  // Takes it: into the replacement if one is being gathered, else behind the last.
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

  // The next `count` items are to replace all behind item `after`. One that was gathered so far is dropped.
  void begin_replacement(uint16_t after, uint8_t count) {
    drop(staged_.front);
    staged_ = {.after = after, .missing = count};
  }
  bool gathering() const { return staged_.missing > 0; }
  // All items have come: now complete() it.
  bool gathered() const { return staged_.front != none && staged_.missing == 0; }
  // The switch. `executed`: the last item that was popped; `begun`: how many at the front are being played or
  // made ready for the timer, and stay. False where an item behind the one to replace after has begun: all stays as it
  // was. The longest work of all: Pause{}() is called between its parts.
  template <class Pause = NoPause>
  bool complete(uint16_t executed, uint8_t begun) {
    uint8_t slot = front_;
    uint8_t place = 1;
    for (; slot != none && slots_[slot].number != staged_.after; slot = slots_[slot].next) ++place;
    const bool behind_all = slot == none && begun == 0 && executed == staged_.after;
    Pause{}();
    const bool in_time = behind_all || (slot != none && place >= begun);
    if (in_time) {
      uint8_t& end = slot == none ? front_ : slots_[slot].next;
      drop(end);
      Pause{}();
      end = staged_.front;
      last_ = staged_.last;
      size_ = 0;
      for (uint8_t left = front_; left != none; left = slots_[left].next) ++size_;
    } else {
      drop(staged_.front);
    }
    staged_ = {};
    return in_time;
  }

 private:
  struct Replacement {
    uint16_t after = 0;
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
  void give_back(uint8_t slot) {
    slots_[slot].next = unused_;
    unused_ = slot;
    ++free_;
  }
  void drop(uint8_t slot) {
    while (slot != none) {
      const uint8_t next = slots_[slot].next;
      give_back(slot);
      slot = next;
    }
  }

  BoardItemSlot slots_[slot_count];
  uint8_t front_ = none;
  uint8_t last_ = none;
  uint8_t unused_ = none;  // the first free slot
  uint8_t free_ = 0;
  uint8_t size_ = 0;  // of the list itself
  Replacement staged_;
};

}  // namespace passo
