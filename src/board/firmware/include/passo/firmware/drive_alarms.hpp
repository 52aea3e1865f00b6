// Drive alarms: inputs of a board that are alarms of drives, as the host's setup says. They stop the motors, and at
// rest the board too, because what holds the machine may be gone. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/message.hpp"

namespace passo {

// The alarms of a board's hardware, as bits of BoardInput. Hardware may have
//   static uint16_t alarms();
template <class Hardware>
[[gnu::always_inline]] inline uint16_t alarms_of(const Hardware& hardware) {
  if constexpr (requires { hardware.alarms(); }) return hardware.alarms();
  return 0;
}

// With these alarms: the inputs that stop a board at rest, too; those that a person presses; why inputs stop the
// motors.
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
