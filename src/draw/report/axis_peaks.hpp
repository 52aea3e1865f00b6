// AxisPeaks: the maximum speed and acceleration of each axis. Private to report/.
#pragma once

#include "passo/trajectory/phase.hpp"

namespace passo {

class AxisPeaks {
 public:
  void watch(const PlannedMove& move);

  double speed(Axis axis) const { return speed_[axis]; }
  double acceleration(Axis axis) const { return acceleration_[axis]; }

 private:
  void watch_straight(const PlannedMove& move, AxisSet bent);

  PerAxis<double> speed_;
  PerAxis<double> acceleration_;
};

}  // namespace passo
