// BoardSegment: the unit of motion that the board executes. All motors share one event clock.
//
// Time. Intervals are ticks of the board's timer in 16.16 fixed point. The first event comes `interval` after the last
// event of the previous segment; each next interval is longer by `change`. segment_parts.hpp describes the other form,
// in which the change grows. The fraction of a tick is carried over from segment to segment.
//
// Position. Each motor has a position in 1/65536 of a step, and every event adds a signed increment of at most one
// step. A step is a change of the position's integer part. The board stores only the fraction (the accumulator: 16
// bits, carried over from segment to segment), and a step is the carry of the addition. An increment d is sent modulo
// 65536 with a flip bit, so that one addition works for both directions, and also for the master axis, which steps at
// every event:
//
//       d in steps        increment     flip    a step when
//       0 <= d < 1        d             0       there is a carry
//       d = +1            0             1       always (no carry, flipped)
//      -1 <  d < 0        1 − |d|       1       there is no carry: the fraction went below zero
//       d = −1            0             1       always
//
//   step = carry XOR flip;  the direction is sent separately.
//
// Portable.
#pragma once

#include <stdint.h>

namespace passo {

inline constexpr uint8_t max_motors = 8;

template <uint8_t motors>
struct SegmentFor {
  // On a board with little memory, two of these share a byte.
  static constexpr uint8_t half = motors <= 4 ? 4 : 8;
  uint16_t events = 0;            // 1 to most_events
  uint8_t directions : half = 0;  // bit m: motor m counts down
  uint8_t flips : half = 0;       // bit m: flip motor m's carry
  uint8_t form : half = 0;        // parts, and how the intervals change: segment_parts.hpp
  uint8_t bend : half = 0;        // the motor whose increment changes: bend_of(). 0: none
  uint32_t interval = 0;          // 16.16 ticks
  // Even: 16.16 ticks per event. Root: the growth. Either at most fine_change, or a multiple of coarse_change.
  int32_t change = 0;
  uint16_t increments[motors] = {};
};
using BoardSegment = SegmentFor<max_motors>;

inline constexpr uint16_t most_events = 0x7ff;
// In a message, a change has 24 bits. A large change is sent without its lowest eight bits.
inline constexpr int32_t fine_change = 0x7fffff;
inline constexpr int32_t coarse_change = 0x100;
// Fields of the event count on the wire: coarse_bit marks a large change; the form starts at bit form_place.
inline constexpr uint16_t coarse_bit = 0x8000;
inline constexpr uint8_t form_place = 11;
inline constexpr uint8_t root_form = 8;

// A bend: the increments of motors change from part to part, and the field of the motor `lender` carries the change.
//
//   The lender does not move (it is not flipped).    Its field is added to the increment of the motor `bent`.
//   The lender steps at every event (it is flipped,  Its field has two signed bytes, the low one first. The increments
//   so its own increment is 0).                      of the first two other motors grow by them, times 4^bent.
//
// 0: no bend.
struct Bend {
  uint8_t bent = 0;
  uint8_t lender = 0;
};
template <uint8_t motors>
constexpr uint8_t bend_shift = motors <= 4 ? 2 : 4;
template <uint8_t motors>
constexpr Bend bend_of(const SegmentFor<motors>& segment) {
  const uint8_t code = segment.bend;
  return {.bent = static_cast<uint8_t>(code & ((1U << bend_shift<motors>)-1)),
          .lender = static_cast<uint8_t>(code >> bend_shift<motors>)};
}
template <uint8_t motors>
constexpr bool bends_two(const SegmentFor<motors>& segment, uint8_t lender) {
  return (segment.flips >> lender & 1) != 0;
}
// The two motors with a bend, if a motor that steps at every event lends its field.
constexpr uint8_t first_beside(uint8_t lender) {
  return lender == 0 ? 1 : 0;
}
constexpr uint8_t second_beside(uint8_t lender) {
  return lender <= 1 ? 2 : 1;
}
inline constexpr uint8_t least_motors_to_bend_two = 3;
inline constexpr uint8_t largest_scale = 3;  // of a bend of two motors: `bent`
inline constexpr int32_t largest_change = fine_change * coarse_change;
constexpr bool is_fine(int32_t change) {
  return change <= fine_change && change >= -fine_change;
}
inline constexpr uint32_t largest_interval = 0xffffffff;
// One whole step in units of the accumulator, and one whole tick in units of the interval.
inline constexpr int32_t whole_step = 65536;
inline constexpr int64_t whole_tick = 65536;

// All digital outputs and the spindle speed. They are switched at their position in the motion.
struct BoardOutputs {
  uint8_t switches = 0;  // bits: OutputSwitch
  uint16_t spindle_rpm = 0;
  friend constexpr bool operator==(const BoardOutputs&, const BoardOutputs&) = default;
};
// The speed at which the PWM of the boards is always on.
inline constexpr uint16_t full_duty_rpm = 24'000;
enum OutputSwitch : uint8_t { spindle_on = 1, spindle_reverse = 2, mist_on = 4, flood_on = 8 };

}  // namespace passo
