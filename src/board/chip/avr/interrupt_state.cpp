// The memory that the step timer's interrupt and the main loop share.
#include "event_ring.hpp"
#include "step_interrupt.hpp"

namespace passo::chip {

extern "C" {

Expansion expansion;
volatile uint8_t running;
// At first nobody looks: fetch() waits for timers that do not run yet. restart() sets it to 0.
volatile uint8_t line_is_watched = 1;
volatile uint8_t turns_tail = turns_address & 0xff;
volatile uint8_t action_at_end;
volatile uint8_t received_head;
volatile uint8_t armed;
volatile uint16_t captured_entry;
volatile uint8_t halted;
volatile uint16_t watch_port;
volatile uint8_t watch_pins;
volatile uint8_t watch_quiet;
volatile uint8_t stops_b;
#ifdef __AVR_ATmega2560__
volatile uint8_t stops_d;
volatile uint8_t stops_e;
volatile uint8_t stops_j;
volatile uint8_t quiet_b;
volatile uint8_t quiet_d;
volatile uint8_t quiet_e;
volatile uint8_t quiet_j;
#else
volatile uint8_t stops_c;
#endif
}

}  // namespace passo::chip
