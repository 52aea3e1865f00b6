// SpeedLaw: how the speed along the path may change. Planner is the same for every law. AccelerationLaw limits how fast
// the speed changes; JerkLaw also limits how fast that acceleration changes. Private to trajectory/.
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

// A law plans from the end of the last move that it gave. A move lies on the path's first segment, and takes no longer
// than the wishes allow. The caller removes the segment when its end is reached.
class SpeedLaw {
 public:
  virtual ~SpeedLaw() = default;

  // Begins anew, from rest at the start of the path's first segment.
  virtual void begin() = 0;
  // Call when the feeds of the wishes have changed.
  virtual void feeds_changed() = 0;
  // Call when the path goes on where it ended until now (PathAhead::go_on()).
  virtual void path_grew() = 0;
  // Gives the next move of the fastest motion. Returns false at rest before an action or at the path's end.
  [[nodiscard]] virtual bool go_on(PlannedMove& move) = 0;
  // Gives the next move on the shortest way to rest. Returns false at rest.
  [[nodiscard]] virtual bool brake(PlannedMove& move) = 0;
  // A way to rest from here, without giving any move of it: gentle, all moves that brake() would give.
  virtual void braking_plan(Planner::Braking how, std::vector<PlannedMove>& plan) = 0;
};

// What a law plans by. All of it must outlive the law.
struct LawInputs {
  PathAhead& path;
  const MotionLimits& limits;
  const MidRunWishes& wishes;
  std::size_t most_queued = 0;  // cells
};
std::unique_ptr<SpeedLaw> acceleration_law(const LawInputs& inputs);
std::unique_ptr<SpeedLaw> jerk_law(const LawInputs& inputs);

}  // namespace passo
