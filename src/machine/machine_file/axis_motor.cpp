#include "passo/machine_file/axis_motor.hpp"

#include <algorithm>

namespace passo {

MmPerSecond2 AxisMotor::acceleration_at(MmPerSecond speed) const {
  const RadiansPerSecond shaft{speed.value() * radians_per_unit};
  const double torque = share * curve.pull_out(shaft).value - load.friction_at(shaft).value;
  const double inertia = curve.rotor().inertia.value + load.inertia.value;
  return MmPerSecond2(std::max(torque, 0.0) / inertia / radians_per_unit);
}

MmPerSecond AxisMotor::fastest_with(MmPerSecond2 least) const {
  double low = 0;
  double high = 1;
  constexpr double beyond_any_axis = 1e6;
  while (high < beyond_any_axis && acceleration_at(MmPerSecond(high)) >= least) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (acceleration_at(MmPerSecond(middle)) >= least ? low : high) = middle;
  }
  return MmPerSecond(low);
}

}  // namespace passo
