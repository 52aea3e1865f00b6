// AxisMotor: the acceleration that the motor of an axis can give, at each speed.
//
//     J φ'' = share · pull-out(φ') - friction         J: rotor, load and slide, as felt at the shaft
//
// `share` is the greatest part of pull-out that the motor is asked for, friction included. The rest is kept for what
// the file does not know: resonance, a warm winding, a supply that sags. For braking, where friction helps, the same
// acceleration is allowed.
#pragma once

#include <optional>

#include "passo/motor/torque_curve.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The electrical half of a motor. A motor that is known by measured torque has none.
struct DrivenMotor {
  MotorData data = {};
  MotorDrive drive = {};
};

struct AxisMotor {
  TorqueCurve curve;
  Load load = {};  // everything that turns, except the rotor
  double share = 0.7;
  double radians_per_unit = 0;  // radians of the shaft for each millimetre or degree of the axis
  std::optional<DrivenMotor> driven = {};
  NewtonMetres detent = {};
  NewtonMetres weight = {};  // pulls towards the low end of the travel, as felt at the shaft

  // The acceleration at a speed. 0 where no torque is left. It never rises with the speed.
  MmPerSecond2 acceleration_at(MmPerSecond speed) const;
  // The highest speed at which `least` is left.
  MmPerSecond fastest_with(MmPerSecond2 least) const;
};

}  // namespace passo
