// JerkWindow: the cells of the path ahead, as many as are needed, and the plan over them. Private to trajectory/.
//
// Begins at any place of the path, at rest or at a speed without acceleration, and gives phases from there on to the
// next rest that is an action or the end.
#pragma once

#include <cstddef>
#include <vector>

#include "feed_factors.hpp"
#include "jerk_profile.hpp"
#include "path_ahead.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo {

class JerkWindow {
 public:
  // Both outlive it.
  JerkWindow(const std::vector<LimitedAxis>& axes, PathAhead& path, std::size_t most_queued);

  // From that place of that segment of the path on.
  struct Start {
    std::size_t segment = 0;
    double s = 0;
    double speed = 0;
  };
  void begin_at(const Start& start, const FeedFactors& feeds);
  // Of cells to come.
  void set_feeds(const FeedFactors& feeds) { feeds_ = feeds; }
  // Whether it can go on from a start in motion, with a rest in sight: not nearer than `way`.
  [[nodiscard]] bool can_go_on(double way);

  // The next phases of the first segment of the path. False at rest at the end of the stretch.
  [[nodiscard]] bool next(PlannedMove& move);
  // What it would give next, if nothing changes: cell `ahead` of those to come, the plan to rest behind what is decided
  // included, which lies on segment `segment` of the path. Both go one on, where it ends there. False at rest at the
  // end.
  [[nodiscard]] bool look_at(std::size_t& ahead, std::size_t& segment, PlannedMove& move) const;
  // The first segment of the path is gone.
  void segment_passed() { --cut_; }

 private:
  bool add_cell(std::size_t i, PlannedMove& move) const;
  void pull();
  void look_ahead();

  PathAhead& path_;
  JerkCutter cutter_;
  JerkProfile profile_;
  std::size_t most_queued_;

  Start start_;
  FeedFactors feeds_;
  std::size_t cut_ = 0;  // segments of the path whose cells are all in the profile
  bool started_ = false;
  bool cutting_ = false;
  bool begins_at_rest_ = true;  // the next cell
  double estimate_ = 0;         // squared: how fast the next cell may be entered
  double length_ = 0;           // of all cells since the start
  bool closed_ = false;
  std::size_t decided_ = 0;  // cells at the front that nothing to come can change
  std::size_t given_ = 0;    // of them
  JerkCell cell_;
  std::vector<AxisShape> shapes_;
};

}  // namespace passo
