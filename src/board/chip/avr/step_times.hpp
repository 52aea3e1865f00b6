// StepTimes: the length of the step pulses, the hold time before direction changes, and the processor time that they
// cost.
//
// Without padding a pulse is as long as the interrupt's own work. With padding the interrupt waits in a loop of three
// cycles per pass. All other work waits too, so the events must be further apart by that time.
#pragma once

#include "registers.hpp"
#include <stdint.h>

#include "passo/wire/message.hpp"

namespace passo::chip {

// In EECR: the interrupt pads its pulses, by the number of passes in EEDR.
inline constexpr uint8_t padding_bit = 4;

struct StepTimes {
  uint8_t shortest_pulse;  // cycles, without padding
  uint8_t first_padding;   // length of a pulse with one pass of the loop
  uint8_t event_ticks;     // the shortest interval between events, without padding
  uint8_t first_turn;      // minimum time from a pulse's end to the first direction change
  uint8_t last_turn;       // maximum time from there to the last direction change
  uint8_t beside_wait;     // ticks per event in addition to its pulse where waits come between events; 0: there are no
                           // waits

  static constexpr uint8_t cycles_a_turn = 3;

  // Sets pulses at least as long as `wanted`, and as the hold time needs. Returns the resulting times. Call only at
  // standstill.
  [[gnu::always_inline]] StepTiming set(const StepTiming& wanted) const {
    uint8_t pulse = shortest_pulse;
    uint8_t turns = 0;
    const uint8_t held = wanted.hold > first_turn ? static_cast<uint8_t>(wanted.hold - first_turn) : uint8_t{0};
    const uint8_t needed = wanted.pulse > held ? wanted.pulse : held;
    if (needed > pulse) {
      turns = 1;
      for (pulse = first_padding; pulse < needed && pulse < longest_pulse; pulse += cycles_a_turn) ++turns;
    }
    Eedr::write(turns);
    Eecr::write(turns != 0 ? 1 << padding_bit : 0);
    const uint16_t padded = static_cast<uint16_t>(event_ticks + (pulse - shortest_pulse));
    const uint16_t around_turn = static_cast<uint16_t>(pulse + last_turn);
    uint16_t ticks = static_cast<uint16_t>(around_turn + wanted.set_up);
    if (ticks < padded) ticks = padded;
    // Beyond the timer's 256 ticks an event costs more, so the time left after a long pulse is too short there at
    // first.
    const uint16_t with_wait = static_cast<uint16_t>(pulse + beside_wait);
    if (beside_wait != 0 && with_wait > 256) {
      const uint16_t with_margin = static_cast<uint16_t>(with_wait + with_wait / 16);
      if (ticks < with_margin) ticks = with_margin;
    }
    const uint16_t set_up = static_cast<uint16_t>(ticks - around_turn);
    return {.pulse = pulse,
            .set_up = set_up > 0xff ? uint8_t{0xff} : static_cast<uint8_t>(set_up),
            .hold = pulse > 0xff - first_turn ? uint8_t{0xff} : static_cast<uint8_t>(pulse + first_turn),
            .event_ticks = ticks};
  }

 private:
  // 10 microseconds: the interrupt after a longer pulse would outlast the UART's buffer.
  static constexpr uint8_t longest_pulse = 160;
};

}  // namespace passo::chip
