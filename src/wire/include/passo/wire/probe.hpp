// ProbeWatch and ProbeReport: what the host asks of the board's probe, and what the board answers.
//
// The board counts every motor's steps from the watch on, and keeps them as they are at the very event at which what
// is waited for happens. So the place of a contact is known to the step, however late the host hears of it. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"

namespace passo {

enum class ProbeUntil : uint8_t {
  off = 0,       // nobody looks at the probe
  touched = 1,   // until it gets from free to touched
  released = 2,  // until it gets from touched to free
};

// Host to board, an item: taken in order with the motion, in no time.
struct ProbeWatch {
  ProbeUntil until = ProbeUntil::off;
};

// Board to host: once when the watch begins, and once more at the event at which it happens.
struct ProbeReport {
  bool touched = false;            // the probe, at that event
  bool happened = false;           // what was waited for
  int32_t steps[max_motors] = {};  // of each motor from the beginning of the watch to that event, up less down
};

}  // namespace passo
