// EmergencyBrake: plans a stop on the path as soon as the axes allow, without jerk limits. Private to trajectory/.
//
// On a small board, the stop ramp at the end of the queue is such a motion (decision 0108). The board executes it only
// if no queue update arrives, e.g. when its link is interrupted. The velocity and acceleration limits, which the
// motors' torque determines, are kept. Jerk limits only prevent vibration during cutting.
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

  // Plans the stop from that state, which must be within the limits and these feeds. Returns false, and an empty plan,
  // if the cells have no motion that is certain to be within the limits, or if the path has an earlier stop. Takes
  // about 0.1 µs per cell; a stop on an arc passes about 30 cells.
  [[nodiscard]] bool plan(PathAhead& path, const PathState& from, const FeedFactors& feeds,
                          std::vector<PlannedMove>& plan);

 private:
  // Returns the squared speed at the end of the segment, or 0 after the stop. Negative: no motion was found.
  double brake_on(const Segment& segment, double from, double speed_squared, double feed,
                  std::vector<PlannedMove>& plan);
  // The same for the end of the current cell. A cell without a possible motion is halved.
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
