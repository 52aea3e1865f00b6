// SegmentSplitter: splits a segment into the parts that a board's player plays (wire/segment_parts.hpp).
//
// Portable: integers only, no heap.
#pragma once

#include <stdint.h>

#include "passo/wire/segment_parts.hpp"

namespace passo {

// `Breath{}()` is called between the steps of the calculation, so that a chip's interrupts do not wait long.
template <uint8_t most_motors, class Breath>
class SegmentSplitter {
 public:
  using Segment = SegmentFor<most_motors>;

  // True if no part of the last segment is left.
  bool are_done() const { return left_ == 0; }
  void drop() { left_ = 0; }
  // Too large for a chip's stack.
  Segment& part() { return part_; }

  // Computes the next part of the segment, or the first one if `begins`. A root segment keeps the growth of the part in
  // its change.
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
  // Advances to the interval after the part. The part is complete: its number of events is a power of two, except in
  // even segments.
  [[gnu::noinline]] void pass(uint8_t form) {
    uint32_t change = static_cast<uint32_t>(part_.change);
    if (form == 0) {
      change *= part_.events;
    } else {
      for (uint8_t doublings = form & ~root_form; doublings != 0; --doublings) change <<= 1;
    }
    part_.interval += change;
  }
  // Sets the part's increments for the motors with a bend.
  [[gnu::noinline]] void bend(const Segment& segment, bool begins) {
    Breath{}();
    if (begins) {
      part_.increments[bend_of(segment).lender] = 0;
    } else {
      bend_on(segment, part_.increments);
    }
  }
  // Sets the part's change for a root segment.
  [[gnu::noinline]] void grow(Segment& segment, bool begins) {
    Breath{}();
    if (!begins) segment.change = next_growth<Breath>(segment.change);
    Breath{}();
    const int32_t twice = twice_factor<Breath>(segment.change);
    Breath{}();
    part_.change = root_change<Breath>(part_.interval, twice, segment.form & ~root_form);
  }

  Segment part_;
  uint16_t left_ = 0;  // events of the segment that are not in a part yet
};

}  // namespace passo
