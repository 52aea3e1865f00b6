// JerkWindow: as many cells of the path ahead as are needed, and the plan over them. Private to trajectory/.
//
// The window begins at any place of the path, at rest or in motion. It gives phases from there to the next rest that is
// an action or the path's end, or to a rest at a place of one's choice.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "feed_factors.hpp"
#include "jerk_profile.hpp"
#include "path_ahead.hpp"
#include "path_state.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo {

class JerkWindow {
 public:
  // `axes`, `path` and `feeds` must outlive the window. Cells are cut for the feeds of that instant.
  JerkWindow(const std::vector<LimitedAxis>& axes, PathAhead& path, const FeedFactors& feeds, std::size_t most_queued,
             const PlanEffort& effort = {});

  void begin_at(const PathState& start);
  // Whether a plan from a start in motion is found, with at least `way` of the path in sight (less where it rests
  // before).
  [[nodiscard]] bool can_go_on(double way);
  // Whether a plan is found from a start in motion to a rest after about that way, or where the path rests before.
  [[nodiscard]] bool can_rest_after(double way);

  // Gives the next phases, all on the first segment of the path. Returns false at rest at the end of the stretch.
  [[nodiscard]] bool next(PlannedMove& move);
  // Shows what comes next if nothing changes: cell number `ahead` from here, which lies on that segment. The plan to
  // rest after the decided cells is included. Returns false at rest at the end.
  [[nodiscard]] bool peek(std::size_t ahead, std::uint64_t segment, PlannedMove& move) const;

 private:
  bool add_cell(std::size_t i, PlannedMove& move) const;
  bool goes_from_rest_to_rest(PlannedMove& move);
  void pull();
  void look_ahead();

  PathAhead& path_;
  const FeedFactors& feeds_;
  JerkCutter cutter_;
  JerkProfile profile_;
  std::size_t most_queued_;

  PathState start_;
  std::uint64_t cut_ = 0;  // the first segment of which not all cells are in the profile
  bool started_ = false;
  bool cutting_ = false;
  double estimate_ = 0;  // squared: the highest entry speed of the next cell
  double length_ = 0;    // of all cells since the start
  double way_to_rest_ = std::numeric_limits<double>::infinity();
  bool closed_ = false;
  std::size_t decided_ = 0;  // cells at the front that nothing to come can change
  std::size_t given_ = 0;    // of the decided cells
  JerkCell cell_;
  std::vector<AxisShape> shapes_;
};

}  // namespace passo
