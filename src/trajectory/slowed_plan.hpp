// SlowedPlan: the planned motion, ever slower. Private to trajectory/.
//
// A plan that uses limits to the full leaves no room for a stop. With every speed times f, accelerations get f² and
// jerks f³ times as large, so a plan that is a little slower leaves a little room, and in it the plan gets slower
// still:
//
//     1 + e - f = e cosh g t
//
// The change asks for f'' v + 3 f' a of an axis' jerk and f' v of its acceleration. What 1 + e - f leaves is 3 and 2
// times as large a share of the limits. g is chosen so that the one is within the other on every axis.
#pragma once

#include <cstdint>
#include <vector>

#include "jerk_cell.hpp"
#include "path_state.hpp"
#include "speed_change.hpp"

namespace passo {

class SlowedPlan {
 public:
  // From that state of the plan on.
  SlowedPlan(const std::vector<LimitedAxis>& axes, const PathState& state);

  // Adds the plan's next move, which lies on that segment. Returns false where no phases lead so.
  [[nodiscard]] bool add(const PlannedMove& move, std::uint64_t segment);

  const PathState& state() const { return state_; }
  double factor() const;  // of the plan's speed
  Seconds duration() const { return Seconds(duration_); }
  const std::vector<SpeedChange::Piece>& pieces() const { return pieces_; }

 private:
  [[nodiscard]] bool add(const Phase& planned, std::uint64_t segment);
  double rate(double speed) const;

  const std::vector<LimitedAxis>& axes_;
  PathState state_;
  double lacks_;        // 1 + e - f
  double lacking_ = 0;  // its change, 1/s
  double duration_ = 0;
  std::vector<SpeedChange::Piece> pieces_;
};

}  // namespace passo
