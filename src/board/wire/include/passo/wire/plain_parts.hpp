// Plain parts: divides a segment into plain segments, with bends and roots resolved, as a player executes them. For the
// host.
//
// Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/segment_parts.hpp"

namespace passo {

// Calls `each` with BoardSegments of at most 255 events, in order.
template <class Each>
void for_each_plain_part(const BoardSegment& segment, const Each& each) {
  BoardSegment plain = segment;
  plain.form = plain.bend = 0;
  if (segment.bend != 0) plain.increments[bend_of(segment).lender] = 0;
  for_each_part(segment, [&](const PartTimes& times, uint16_t events, uint16_t before) {
    if (segment.bend != 0 && before != 0) bend_on(segment, plain.increments);
    plain.events = events;
    plain.interval = times.interval;
    plain.change = times.change;
    each(plain);
  });
}

}  // namespace passo
