// StabilitySweep: determines the rate up to which a motor runs without self-excited oscillation. Private to tuning/.
//
// Mid-band instability and resonance begin at rates that no formula predicts to within a few per cent, and they take
// time to build up. Therefore the motor is simulated in a slow sweep through all rates, and the fluctuation of its lag
// about the mean is measured.
#pragma once

#include "passo/motor/running_motor.hpp"

namespace passo {

// Returns the rate in full steps/s; `fastest` if the motor does not oscillate below it. `late`: the fraction of an
// interval by which a step may be late, as on a board whose events are those of a faster motor.
Hertz calm_up_to(const MotorSetup& setup, Hertz fastest, double late);

}  // namespace passo
