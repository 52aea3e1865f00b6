// EmergencyBrake: from motion on the path to rest, as soon as the axes can, whatever their limits of jerk. Private to
// trajectory/.
//
// Where a board is small, the end of what the board holds is such a motion (decision 0108). The board plays it only
// if nothing more comes, when its line is cut for instance. Velocities and accelerations, which the torque of the
// motors limits, are kept. Limits of jerk keep a machine from shaking while it cuts.
#pragma once

#include <vector>

#include "cell.hpp"
#include "feed_factors.hpp"
#include "path_ahead.hpp"
#include "path_state.hpp"
#include "speed_window.hpp"

#include "passo/trajectory/motion_limits.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class EmergencyBrake {
 public:
  // `limits` must outlive the brake.
  explicit EmergencyBrake(const MotionLimits& limits);

  // Plans the way to rest from that state, which must be within the limits and these feeds. Returns false, and an empty
  // plan, where the cells leave no way that is surely within the limits, or where the path rests before the motion
  // could. Takes about 0.1 µs a cell; a stop on an arc passes some 30 cells.
  [[nodiscard]] bool plan(PathAhead& path, const PathState& from, const FeedFactors& feeds,
                          std::vector<PlannedMove>& plan);

 private:
  // The square of the speed at the end of the segment, or 0 and the rest. Below 0: there is no way.
  double brake_on(const Segment& segment, double from, double speed_squared, double feed,
                  std::vector<PlannedMove>& plan);
  // The same at the end of the cell that was cut. A cell that leaves no way is cut in halves.
  double brake_in_cell(const Segment& segment, double entry, int halvings, std::vector<PlannedMove>& plan);
  bool allows(double entry, const Ride& ride) const;
  CellPlace place() { return {cell_, demands_.data(), falling_.data()}; }

  CellCutter cutter_;
  double most_squared_ = 0;  // the square of the highest speed by the feed
  Cell cell_;
  std::vector<AxisDemand> demands_;
  std::vector<FallingDemand> falling_;
};

}  // namespace passo
