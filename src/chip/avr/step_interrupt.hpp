// What the step timer's interrupt and the main loop share, and the two pieces of assembly.
//
// Registers r2 to r5 are the interrupt's for the whole program. clang cannot be told so: it takes them last, the
// program is written so that it never has to, and scripts/board_checks.sh looks for it in the finished program.
//   r3:r2  the next entry of the ring     r4  scratch     r5  what to turn over at the next event
#pragma once

#include <stdint.h>

namespace passo::chip {

extern "C" {
// The segment that is being made into events; the expander's registers between two calls. Same order as in `expand`.
struct Expansion {
  uint16_t accumulators[3];
  uint16_t increments[3];
  uint32_t time;      // 16.16 ticks, modulo 2^16: of the event made last
  uint32_t interval;  // to the next one
  int32_t change;
  uint8_t flips;     // as bits of the step port
  uint16_t address;  // of the entry to be written next
};
extern Expansion expansion;

extern volatile uint8_t running;          // the interrupt plays
extern volatile uint8_t line_is_watched;  // by the interrupt, which comes often: the main loop need not look
extern volatile uint8_t turns_tail;       // low byte of the address of the next turn
extern volatile uint8_t received_head;    // low byte of the address where the next byte off the line goes
extern volatile uint8_t stop_low_b;       // pins of port B, C that stop everything when they are
extern volatile uint8_t stop_low_c;       //   not as in `quiet`
extern volatile uint8_t quiet_b;
extern volatile uint8_t quiet_c;
extern volatile uint8_t probe_mask;    // armed: the probe's pin of port C
extern volatile uint16_t probe_entry;  // r3:r2 when it touched; 0: not yet
extern volatile uint8_t halted;        // by a pin

// Makes the next `events` events (at least one) of the segment and puts them into the ring. The first keeps both flags
// set, so that the interrupt does not run into what is not finished. Reads the line between events.
void expand(uint8_t events);
}

}  // namespace passo::chip
