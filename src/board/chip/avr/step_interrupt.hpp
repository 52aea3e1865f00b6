// The data that the step timer's interrupt and the main loop share, and the two assembly routines.
//
// Registers r2 to r5 belong to the interrupt for the whole program. clang has no option that reserves them. It
// allocates these registers last, the program is written so that it never needs them, and check_program.sh checks the
// finished program for their use.
//   Uno    r3:r2  the next entry of the ring, whose page r3 stays   r4  scratch           r5  the next event's bits
//   Mega      r2  the next entry of the ring                        r3, r4, r6  scratch   r5  on the first step port
// With windings (winding_events.cpp) both routines are C++, and no registers are reserved.
#pragma once

#include "event_ring.hpp"
#include <stdint.h>

namespace passo::chip {

extern "C" {
// The segment of which events are made: the values of the expander's registers between two calls, in the order of
// `expand`.
struct Expansion {
  uint16_t accumulators[pins.motors];
  uint16_t increments[pins.motors];
  uint32_t time;      // 16.16 ticks, modulo 2^16: the time of the last event made
  uint32_t interval;  // ticks to the next event
  int32_t change;
#ifdef PASSO_WINDINGS
  uint8_t flips;
  uint8_t directions;
#else
  PortBits flips;  // in the bits of the step ports
#endif
  uint16_t address;  // the entry to write next
  uint8_t motors;    // number of motors that the host uses
#if !defined PASSO_WINDINGS && !defined __AVR_ATmega2560__
  // For `expand_slowly`: the number of events that it may still make, and the state of an interrupted wait for the next
  // event.
  uint8_t events;
  uint8_t waits;    // whole waits of 256 ticks still to make
  uint8_t rest;     // remaining ticks after them, less 129
  uint8_t is_amid;  // the wait has begun: `time` is already the event's
  uint8_t at;       // the low byte of the last entry's time
#endif
#ifdef PASSO_WINDINGS
  uint8_t places[pins.motors];  // index in each motor's WindingTable
  uint8_t held[pins.motors];    // the table index whose windings have current, or windings_off
#endif
};
extern Expansion expansion;

extern volatile uint8_t running;          // the interrupt is playing
extern volatile uint8_t line_is_watched;  // the interrupt comes often enough to read the serial port; the main loop
                                          // need not
extern volatile uint8_t turns_tail;       // low byte of the address of the next direction change
extern volatile uint8_t action_at_end;    // low byte of the address of the action at the end of the ring; 0: none
extern volatile uint8_t received_head;    // low byte of the address for the next received byte
extern volatile uint8_t armed;            // the watched input has not changed yet
extern volatile uint16_t captured_entry;  // the ring's register when it changed
// A pin that stops the motion was triggered. Without a filter the motion has stopped; otherwise the main loop checks
// whether the pin stays triggered.
extern volatile uint8_t halted;
// In EECR: the interrupt has stopped for good, possibly while the expander works. So the expander reads the serial
// port.
inline constexpr uint8_t halted_bit = 5;
// The watched pins of one port: the address of its PINx, the pins, and their levels before the change. At the first
// change the interrupt stores the changed pins in `watch_pins`.
extern volatile uint16_t watch_port;
extern volatile uint8_t watch_pins;
extern volatile uint8_t watch_quiet;
// The pins of a port whose switches stop everything when triggered.
#ifdef __AVR_ATmega2560__
extern volatile uint8_t stops_b;
extern volatile uint8_t stops_d;
extern volatile uint8_t stops_e;
extern volatile uint8_t stops_j;
// The levels of a port's pins while their switches are open.
extern volatile uint8_t quiet_b;
extern volatile uint8_t quiet_d;
extern volatile uint8_t quiet_e;
extern volatile uint8_t quiet_j;
#else
extern volatile uint8_t stops_b;
extern volatile uint8_t stops_c;
// The idle levels of ports B and C are in OCR0B and EEARL, because the Uno's memory has no byte left.
#endif

// Makes the next `events` events (at least one) of the segment and puts them into the ring. The first one keeps both
// flags set, so that the interrupt does not run into unfinished entries. Reads the serial port between events.
void expand(uint8_t events);
#if !defined PASSO_WINDINGS && !defined __AVR_ATmega2560__
// The same for events that may be further apart than the timer's 256 ticks, with wait entries in between. All intervals
// are under 512 ticks: up to two entries per event. Returns the low byte of the address after the last entry.
uint8_t expand_with_waits(uint8_t events);
// The same for any intervals. Makes entries for at most expansion.events events, and no more than `entries` entries,
// which must be at least one. Returns `entries` less the number of entries made.
uint8_t expand_slowly(uint8_t entries);
#endif
}

}  // namespace passo::chip
