// CalmSweep: up to which rate a motor runs without swinging by itself. Private to tuning/.
//
// Mid-band instability and resonance begin at rates that no formula gives to a few per cent, and need time to grow. So
// the motor is swept slowly through all rates, with its physics, and watched: how far the lag moves about its mean.
#pragma once

#include "passo/motor/running_motor.hpp"

namespace passo {

// In full steps a second; `fastest` if the motor is calm everywhere below. `late`: the share of an interval by which a
// step may come late, as at a board whose events are those of a faster motor.
Hertz calm_up_to(const MotorSetup& setup, Hertz fastest, double late);

}  // namespace passo
