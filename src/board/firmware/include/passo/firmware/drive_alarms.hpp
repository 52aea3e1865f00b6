// Drive alarms: inputs of a board that the host's setup declares as alarms of drives. They stop the motors, and block
// the board at standstill too, because the axes may no longer be held. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/message.hpp"

namespace passo {

// Returns the drive alarm inputs of a board's hardware, as bits of BoardInput. Hardware may have
//   static uint16_t alarms();
template <class Hardware>
[[gnu::always_inline]] inline uint16_t alarms_of(const Hardware& hardware) {
  if constexpr (requires { hardware.alarms(); }) return hardware.alarms();
  return 0;
}

// For these alarms: the inputs that also stop a board at standstill; the inputs that the operator presses; the reason
// why inputs stop the motors.
constexpr uint16_t stopping_at_rest(uint16_t alarms) {
  return static_cast<uint16_t>(input_emergency_stop | alarms);
}
constexpr uint16_t pressed_by_people(uint16_t alarms) {
  return static_cast<uint16_t>((input_door | input_hold | input_start) & ~alarms);
}
constexpr FaultReason reason_of(uint16_t stopping, uint16_t alarms) {
  return (stopping & input_emergency_stop) != 0 ? FaultReason::emergency_stop
         : (stopping & alarms) != 0             ? FaultReason::driver
                                                : FaultReason::limit;
}

}  // namespace passo
