// PartTaker: takes a segment apart into the parts that a board's player plays (wire/segment_parts.hpp).
//
// Portable: integers only, no heap.
#pragma once

#include <stdint.h>

#include "passo/wire/segment_parts.hpp"

namespace passo {

// `Breath{}()` is called between the steps of the work, so that a chip's interrupts do not wait long.
template <uint8_t most_motors, class Breath>
class PartTaker {
 public:
  using Segment = SegmentFor<most_motors>;

  // No part of the last segment is left.
  bool are_done() const { return left_ == 0; }
  void drop() { left_ = 0; }
  // Too large for a chip's stack.
  Segment& part() { return part_; }

  // Takes the next part of the segment, or the first one if it begins. A segment with a root keeps the growth of the
  // part in its change.
  [[gnu::always_inline]] void take(Segment& segment, bool begins) {
    Breath{}();
    if (begins) {
      part_ = segment;
      Breath{}();
      part_.form = 0;
      left_ = segment.events;
    } else {
      pass(segment.form);
    }
    Breath{}();
    const uint8_t length = part_length(segment.form);
    part_.events = left_ < length ? left_ : length;
    left_ = static_cast<uint16_t>(left_ - part_.events);
    Breath{}();
    if (segment.bend != 0) bend(segment, begins);
    if (is_root(segment.form)) grow(segment, begins);
    Breath{}();
  }

 private:
  // Goes on to the interval behind the part. It has all its events: a power of two, but for even segments.
  [[gnu::noinline]] void pass(uint8_t form) {
    uint32_t change = static_cast<uint32_t>(part_.change);
    if (form == 0) {
      change *= part_.events;
    } else {
      for (uint8_t doublings = form & ~root_form; doublings != 0; --doublings) change <<= 1;
    }
    part_.interval += change;
  }
  // Gives the part the increments that bent motors have there.
  [[gnu::noinline]] void bend(const Segment& segment, bool begins) {
    Breath{}();
    if (begins) {
      part_.increments[bend_of(segment).lender] = 0;
    } else {
      bend_on(segment, part_.increments);
    }
  }
  // Gives the part the change that a root has there.
  [[gnu::noinline]] void grow(Segment& segment, bool begins) {
    Breath{}();
    if (!begins) segment.change = next_growth<Breath>(segment.change);
    Breath{}();
    const int32_t twice = twice_factor<Breath>(segment.change);
    Breath{}();
    part_.change = root_change<Breath>(part_.interval, twice, segment.form & ~root_form);
  }

  Segment part_;
  uint16_t left_ = 0;  // events of the segment that were not taken yet
};

}  // namespace passo
