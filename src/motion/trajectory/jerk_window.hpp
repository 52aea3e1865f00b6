// JerkWindow: the cells of the path ahead, as many as are needed, and the plan over them. Private to trajectory/.
//
// The window begins at any point of the path, at a stop or in motion. It returns phases from there to the next stop at
// an action or at the path's end, or to a stop at a chosen point.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "feed_factors.hpp"
#include "jerk_profile.hpp"
#include "path_ahead.hpp"
#include "path_state.hpp"
#include "rest.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo {

class JerkWindow {
 public:
  struct Inputs {
    const std::vector<LimitedAxis>& axes;
    PathAhead& path;
    const FeedFactors& feeds;           // cells are cut for the feeds at construction
    const StopSpeeds* stops = nullptr;  // the speeds at stops; null: none
    std::size_t most_queued = 0;
  };
  // The inputs must outlive the window.
  explicit JerkWindow(const Inputs& inputs, const PlanEffort& effort = {});

  // Begins there. At a stop: `stopped` is the velocity with which the motion before ended.
  void begin_at(const PathState& start, const Point& stopped = {});
  // Whether a plan from a start in motion is found, with at least the distance `way` of the path in view (less if the
  // path stops before).
  [[nodiscard]] bool can_go_on(double way);
  // Whether a plan is found from a start in motion to a stop after about that distance, or at an earlier stop of the
  // path.
  [[nodiscard]] bool can_rest_after(double way);

  // Returns the next phases, all on the first segment of the path. Returns false when stopped at the end.
  [[nodiscard]] bool next(PlannedMove& move);
  // Returns a preview of the motion without further changes: cell number `ahead` from here, on that segment. The plan
  // to a stop after the decided cells is included. Returns false when stopped at the end.
  [[nodiscard]] bool peek(std::size_t ahead, std::uint64_t segment, PlannedMove& move) const;

 private:
  bool add_cell(std::size_t i, PlannedMove& move) const;
  bool goes_from_rest_to_rest(PlannedMove& move);
  void pull();
  double start_squared(const Segment& first) const;
  void begin_after_stop();
  double end_squared_after(std::uint64_t number, const Point& direction) const;
  void look_ahead();

  PathAhead& path_;
  const FeedFactors& feeds_;
  const StopSpeeds* stops_;
  JerkCutter cutter_;
  JerkProfile profile_;
  std::size_t most_queued_;

  // The speeds that the stops at both ends allow.
  struct Stops {
    Point stopped;              // the velocity with which the motion before the start ended
    bool after_corner = false;  // the window before ended in `end_direction`
    double end_squared = 0;     // if closed: the greatest speed at the end
    Point end_direction;        // if closed
  };

  PathState start_;
  Stops at_stops_;
  std::uint64_t cut_ = 0;  // the first segment that is not completely in the profile
  bool started_ = false;
  bool cutting_ = false;
  double estimate_ = 0;  // squared: the highest entry speed of the next cell
  double length_ = 0;    // of all cells since the start
  double way_to_rest_ = std::numeric_limits<double>::infinity();
  bool closed_ = false;
  std::size_t decided_ = 0;  // cells at the front that later cells cannot change
  std::size_t given_ = 0;    // of the decided cells, those returned
  JerkCell cell_;
  std::vector<AxisShape> shapes_;
};

}  // namespace passo
