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

// The torque of a motor of the shelf differs from its data sheet by up to this share, where the file tells nothing
// else.
inline constexpr double usual_tolerance = 0.15;

struct AxisMotor {
  TorqueCurve curve;
  Load load = {};  // everything that turns, except the rotor
  double share = 0.7;
  double tolerance = usual_tolerance;
  bool limits_motion = true;    // false: the axis has constant acceleration, and its motor is only checked
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
