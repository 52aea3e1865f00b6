// JerkCell: a short part of a segment for the jerk-limited profile, and the shape of each axis over it. Private to
// trajectory/.
//
// Let q(s) be the place of an axis, and v, a, j speed, acceleration and jerk along the path. The axis moves with
//
//     velocity q' v      acceleration q' a + q'' v²      jerk q' j + 3 q'' v a + q''' v³
//
// Cells are so short that about ten of them pass while the acceleration rises from 0 to its limit.
#pragma once

#include <limits>
#include <vector>

#include "limited_axis.hpp"
#include "rest_to_rest.hpp"

#include "passo/path/segment.hpp"

namespace passo {

// The derivatives of an axis's place by s, at the start and at the end of a cell. The third is straight in between.
struct AxisShape {
  double slope_in = 0;
  double slope_out = 0;
  double bend_in = 0;
  double bend_out = 0;
  double third_in = 0;
  double third_out = 0;

  // In the middle of a cell of this length.
  double third_middle() const { return (third_in + third_out) / 2; }
  double bend_middle() const { return (bend_in + bend_out) / 2; }
  double slope_middle(double length) const { return (slope_in + slope_out) / 2 - length * length / 8 * third_middle(); }
};

// The path's second derivative may change where segments join. Such a joint is passed so slowly that no axis's
// acceleration jumps by more than this share of its limit.
inline constexpr double unseen_jump = 2e-4;

struct JerkCell {
  double start = 0;         // s on the segment's curve
  double length = 0;        // mm, above 0
  double top_squared = 0;   // the limit by the feed; straight cells: by the axes' velocities too
  double acceleration = 0;  // straight cells: what the axes allow along the path
  double jerk = 0;
  bool straight = false;  // on a line, and the acceleration of no axis falls
  bool ends_segment = false;
};

class JerkCutter {
 public:
  explicit JerkCutter(const std::vector<LimitedAxis>& axes) : axes_(axes) {}

  // The part of a segment to cut, and the highest speeds at its start and end. Cells are shorter where motion is slow.
  struct Cut {
    double from = 0;  // s
    double to = std::numeric_limits<double>::infinity();
    double entry_squared = 0;
    double exit_squared = 0;
    double feed = 0;  // mm/s
  };
  void begin(const Segment& segment, const Cut& cut);
  // Whether what the axes allow along the segment is the same everywhere, and what that is.
  bool is_straight() const { return straight_; }
  PathLimits path_limits() const { return {.speed = top_, .acceleration = acceleration_, .jerk = jerk_}; }
  // Writes the next cell; `shapes` takes one entry for each axis. Returns false at the end.
  bool next(JerkCell& cell, AxisShape* shapes);

  // The square of the highest speed at which a joint may be passed, for Cut.
  double joint_cap(const Segment& before, const Segment& after) const;

 private:
  double entry_cap(const Segment& segment) const;
  struct Derivatives {
    Point first;
    Point second;
    Point third;
  };
  static Derivatives derivatives(const Curve& curve, double s);
  double speed_estimate(double s) const;

  const std::vector<LimitedAxis>& axes_;
  const Segment* segment_ = nullptr;
  double from_ = 0;
  double at_ = 0;
  double length_ = 0;  // of the whole segment
  double end_ = 0;
  double speed_ = 0;  // the programmed one
  double top_ = 0;
  double acceleration_ = 0;
  double jerk_ = 0;
  double entry_ = 0;
  double exit_ = 0;
  double shortest_ = 0;
  double longest_ = 0;
  double tick_ = 0;   // about the time for one cell
  double reach_ = 0;  // the way in which the motion surely reaches the top from rest
  bool straight_ = false;
  Derivatives here_;
};

}  // namespace passo
