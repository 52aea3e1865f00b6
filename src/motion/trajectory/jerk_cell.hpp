// JerkCell: a short part of a segment for the jerk-limited profile, and the shape of each axis over it. Private to
// trajectory/.
//
// Let q(s) be the position of an axis, and v, a, j speed, acceleration and jerk along the path. Then the axis has
//
//     velocity q' v      acceleration q' a + q'' v²      jerk q' j + 3 q'' v a + q''' v³
//
// Cells are short: the acceleration rises from 0 to its limit over about ten of them.
#pragma once

#include <limits>
#include <vector>

#include "limited_axis.hpp"
#include "rest_to_rest.hpp"

#include "passo/path/segment.hpp"

namespace passo {

// The derivatives of an axis' position by s, at the start and at the end of a cell.
struct AxisShape {
  double slope_in = 0;
  double slope_out = 0;
  double bend_in = 0;
  double bend_out = 0;
  double third_in = 0;
  double third_out = 0;

  // Returns the value in the middle of the cell, if the third derivative is linear.
  double third_middle() const { return (third_in + third_out) / 2; }
  double bend_middle() const { return (bend_in + bend_out) / 2; }
  double slope_middle(double length) const { return (slope_in + slope_out) / 2 - length * length / 8 * third_middle(); }
};

// The derivatives of an axis' position by s anywhere in a cell. The third derivative is the parabola that has the given
// values at both ends, and whose integral is the change of the second derivative. The error is that of the sixth
// derivative of the position, times the cube of the length: on an arc of 0.1 radians 1e-5 of the value.
class ShapeInside {
 public:
  ShapeInside(const AxisShape& ends, double length)
      : ends_(ends),
        length_(length),
        rise_(ends.third_out - ends.third_in),
        bulge_(6 * ((ends.bend_out - ends.bend_in) / length - ends.third_middle())) {
    missing_ = ends.slope_out - slope_without(1);
  }

  // `u`: the share of the length, from 0 to 1.
  double third(double u) const { return ends_.third_in + u * (rise_ + bulge_ * (1 - u)); }
  double bend(double u) const {
    return ends_.bend_in + length_ * u * (ends_.third_in + u * (rise_ / 2 + bulge_ * (0.5 - u / 3)));
  }
  double slope(double u) const { return slope_without(u) + u * missing_; }

 private:
  double slope_without(double u) const {
    const double by_third = ends_.third_in / 2 + u * (rise_ + bulge_ * (1 - u / 2)) / 6;
    return ends_.slope_in + length_ * u * (ends_.bend_in + length_ * u * by_third);
  }

  const AxisShape& ends_;
  double length_;
  double rise_;
  double bulge_;
  double missing_ = 0;  // rounding, and what the parabola leaves
};

// The path's second derivative may change where segments join. Such a joint is passed slowly enough that no axis'
// acceleration jumps by more than this fraction of its limit.
inline constexpr double unseen_jump = 2e-4;

struct JerkCell {
  double start = 0;         // s on the segment's curve
  double length = 0;        // mm, above 0
  double top_squared = 0;   // the limit by the feed; straight cells: also by the axes' velocities
  double acceleration = 0;  // straight cells: the limit of the axes along the path
  double jerk = 0;
  bool straight = false;  // on a line, and no axis' acceleration limit falls
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
  // Whether the axes' limits along the segment are constant, and these limits.
  bool is_straight() const { return straight_; }
  PathLimits path_limits() const { return {.speed = top_, .acceleration = acceleration_, .jerk = jerk_}; }
  // Writes the next cell; `shapes` receives one entry per axis. Returns false at the end.
  bool next(JerkCell& cell, AxisShape* shapes);

  // Returns the square of the highest speed at which a joint may be passed, for Cut.
  double joint_cap(const Segment& before, const Segment& after) const;

 private:
  double entry_cap(const Segment& segment) const;
  struct Derivatives {
    Point first;
    Point second;
    Point third;
  };
  static Derivatives derivatives(const Curve& curve, double s);
  bool limits_speed() const;
  double speed_estimate(double s) const;

  const std::vector<LimitedAxis>& axes_;
  const Segment* segment_ = nullptr;
  double from_ = 0;
  double at_ = 0;
  double length_ = 0;  // of the whole segment
  double end_ = 0;
  double speed_ = 0;  // programmed speed
  double top_ = 0;
  double acceleration_ = 0;
  double jerk_ = 0;
  double entry_ = 0;
  double exit_ = 0;
  double shortest_ = 0;
  double longest_ = 0;
  double tick_ = 0;   // approximate time for one cell
  double reach_ = 0;  // the distance within which the motion certainly reaches the maximum speed from rest
  bool straight_ = false;
  Derivatives here_;
};

}  // namespace passo
