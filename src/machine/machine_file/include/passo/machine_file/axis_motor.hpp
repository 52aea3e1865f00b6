// AxisMotor: the acceleration that the motor of an axis can give, at each speed.
//
//     J φ'' = share · pull-out(φ') - friction         J: rotor, load and slide, reflected to the shaft
//
// `share` is the largest fraction of the pull-out torque that is used, including friction. The remainder is a margin
// for effects that the file does not describe: resonance, warm windings, a weak supply. The same limit applies to
// deceleration, although friction helps there.
#pragma once

#include <optional>

#include "passo/motor/torque_curve.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The electrical data of a motor. A motor with a measured torque curve has none.
struct DrivenMotor {
  MotorData data = {};
  MotorDrive drive = {};
};

// The default tolerance: the torque of a standard motor differs from its data sheet by at most this fraction.
inline constexpr double usual_tolerance = 0.15;

struct AxisMotor {
  TorqueCurve curve;
  Load load = {};  // all inertia and friction, except the rotor's
  double share = 0.7;
  double tolerance = usual_tolerance;
  bool limits_motion = true;    // false: the acceleration is constant, and the motor's torque is only checked
  double radians_per_unit = 0;  // radians of the shaft per millimetre or degree of the axis
  std::optional<DrivenMotor> driven = {};
  NewtonMetres detent = {};
  NewtonMetres weight = {};  // torque at the shaft towards the low end of the travel

  // The acceleration at a speed; 0 if no torque is left. It never rises with the speed.
  MmPerSecond2 acceleration_at(MmPerSecond speed) const;
  // The highest speed at which an acceleration of `least` is possible.
  MmPerSecond fastest_with(MmPerSecond2 least) const;
};

}  // namespace passo
