// SpeedLaw: the rules for changes of the speed along the path. Planner is the same for every law. AccelerationLaw
// limits the acceleration; JerkLaw also limits the rate of change of the acceleration. Private to trajectory/.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "feed_factors.hpp"
#include "path_ahead.hpp"

#include "passo/trajectory/motion_limits.hpp"
#include "passo/trajectory/phase.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

// A law plans from the end of the last move that it returned. A move is on the path's first segment, and takes no
// longer than the real-time requests allow. The caller removes the segment when its end is reached.
class SpeedLaw {
 public:
  virtual ~SpeedLaw() = default;

  // Begins again, from a stop at the start of the path's first segment.
  virtual void begin() = 0;
  // Call when the feeds of the real-time requests have changed.
  virtual void feeds_changed() = 0;
  // Call when the path continues beyond its former end (PathAhead::go_on()).
  virtual void path_grew() = 0;
  // Returns the next move of the fastest motion. Returns false when stopped before an action or at the path's end.
  [[nodiscard]] virtual bool go_on(PlannedMove& move) = 0;
  // Returns the next move of the shortest stop. Returns false when stopped.
  [[nodiscard]] virtual bool brake(PlannedMove& move) = 0;
  // Returns a stop from here, without changing the law's state; if gentle, all moves that brake() would return, and
  // then those from the start-stop velocities down to 0.
  virtual void braking_plan(Planner::Braking how, std::vector<PlannedMove>& plan) = 0;
};

// The inputs of a law. All of them must outlive the law.
struct LawInputs {
  PathAhead& path;
  const MotionLimits& limits;
  const MidRunWishes& wishes;
  std::size_t most_queued = 0;  // cells
};
std::unique_ptr<SpeedLaw> acceleration_law(const LawInputs& inputs);
std::unique_ptr<SpeedLaw> jerk_law(const LawInputs& inputs);

}  // namespace passo
