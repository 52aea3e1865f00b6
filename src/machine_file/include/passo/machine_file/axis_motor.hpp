// AxisMotor: what the motor of an axis leaves for its acceleration, at each speed.
//
//     J φ'' = share · pull-out(φ') - friction         J: rotor, load and slide, as felt at the shaft
//
// `share` of pull-out is the most that is asked of the motor, friction included; the rest is kept for what is not in
// the file: resonance, a warm winding, a supply that sags. For braking, where friction helps, the same is allowed.
#pragma once

#include "passo/motor/torque_curve.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct AxisMotor {
  TorqueCurve curve;
  Load load = {};  // all that turns but the rotor
  double share = 0.7;
  double radians_per_unit = 0;  // of the shaft, a millimetre or degree of the axis

  // 0 where nothing is left. It never rises.
  MmPerSecond2 acceleration_at(MmPerSecond speed) const;
  // Up to here `least` is left.
  MmPerSecond fastest_with(MmPerSecond2 least) const;
};

}  // namespace passo
