// Cell: a short stretch of a segment along which the acceleration along the path is constant. Private to trajectory/.
//
// With q(s) the place of an axis on the path, s the way and v the speed along it, the axis accelerates by
//
//     q' a + q'' v²          a = dv/dt
//
// and must stay within its limit. Where a is constant, v² is a straight line over s: from x at the cell's entry to
// y at its exit, a = (y - x) / 2h. What an axis demands at either end is then linear in x and y, and in between it
// bends by no more than what is taken off the limit beforehand (see cell.cpp): what holds at the ends holds all along.
//
// Source: the linear constraints of time-optimal path following (Bobrow, Dubowsky, Gibson 1985) in the form of
// H. Pham, Q.-C. Pham, "A new approach to time-optimal path parameterization based on reachability analysis" (2018).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "passo/path/segment.hpp"
#include "passo/trajectory/motion_limits.hpp"

namespace passo {

// What one axis demands of the squares of the speeds at the cell's ends:
// |entry_x x + entry_y y| <= limit and |exit_x x + exit_y y| <= limit.
struct AxisDemand {
  double entry_x = 0;
  double entry_y = 0;
  double exit_x = 0;
  double exit_y = 0;
  double limit = 0;
};

// One of each axis, and one of the acceleration along the path.
inline constexpr std::size_t most_demands_of_cell = axis_count + 1;

// Of an axis whose limit falls with its speed. In the cell the square of that is about entry_weight x at the entry and
// exit_weight y at the exit; with each line of the curve, at both ends,
//
//     |demand| + fall w <= at_rest - slack - fall slack_of_fall
//
// holds all along, and keeps to the curve.
struct FallingDemand {
  const AccelerationCurve* curve = nullptr;
  std::uint32_t demand = 0;  // the axis's own among the cell's demands
  std::uint32_t line = 0;    // of the curve, with which the cell was last found possible
  double entry_weight = 0;
  double exit_weight = 0;
  double slack = 0;
  double slack_of_fall = 0;
};

struct Cell {
  double start = 0;         // s on the segment's curve
  double end = 0;           // of the last cell exactly the curve's length
  double length = 0;        // end - start, above 0
  double top_squared = 0;   // by the axes' velocities, anywhere in the cell
  double feed_squared = 0;  // as programmed; infinite for a rapid
  double acceleration = 0;  // along the path, either way, at most; of a straight cell: so much, and the speed may both
                            // rise and fall within
  bool straight = false;
  std::uint8_t demand_count = 0;
  std::uint8_t falling_count = 0;
  SpindleLock lock = SpindleLock::none;
  Heeds heeds = {};
};

// A cell with what it demands, where it is kept: room for a demand of each axis.
struct CellPlace {
  Cell& cell;
  AxisDemand* demands;
  FallingDemand* falling;
};

// Cuts segments into cells. The straight ones are whole segments and make no demands but their acceleration; lines on
// which speeds are possible at which a limit falls are cut like curves. About 100 ns a cell of a cubic with three axes.
class CellCutter {
 public:
  // The limits must live as long.
  explicit CellCutter(const MotionLimits& limits);
  // Of a cell, and how many of them fall with the speed.
  std::size_t most_demands() const;
  std::size_t most_falling() const;

  // Begins with a segment, which must stay where it is, and into which the path comes with this square of the speed at
  // most; next() then gives its cells in order, up to its end.
  void begin(const Segment& segment, double entry_squared);
  bool at_end() const { return !(at_.s < segment_->curve.length().value()); }
  void next(const CellPlace& to);
  // A cell of a segment that is not the one at hand: what is left of one that was given in part, straight or not.
  void cut(const Segment& segment, double from, double to, bool straight, const CellPlace& place) const;

 private:
  // What an axis can do; of 0 or less: anything.
  struct AxisLimits {
    std::size_t axis = 0;
    double velocity = 0;
    double acceleration = 0;
    const AccelerationCurve* falling = nullptr;
  };
  using Axes = std::vector<AxisLimits>;
  // A place on the curve. Where one cell ends the next begins: each is found once.
  struct Place {
    double s = 0;
    Point slope;
    Point bend;
    double turning = 0;  // the square of the highest speed at which all axes together can turn so
  };
  // Bounds of |q'''| and |q''''| between two places.
  struct Bend {
    double third = 0;
    double fourth = 0;
  };
  struct CellBounds {
    const Curve& curve;
    const Bend& of_arc;
    double top_squared = 0;      // by what the axes can do
    double fastest_squared = 0;  // by that and the feed
  };
  struct Strength {  // along the path
    double most = 0;
    bool is_kept = false;  // whatever the speeds, while the axes keep their limits
  };
  static Strength strength_on(const Axes& axes, const Place& in, const Place& out, const CellBounds& bounds,
                              double slope_strength);
  static double top_speed(const Axes& axes, const Point& slope);
  static double top_acceleration(const Axes& axes, const Point& slope);
  static double flat_top(const Axes& axes, const Point& slope);
  static double top_of_turning(const Axes& axes, const Point& slope, const Point& bend);
  static Place place_at(const Curve& curve, const Axes& axes, double s);
  static Bend bend_of_arc(const Curve& curve, const Place& in, const Place& out);
  static Bend bend_on(const Curve& curve, const Bend& of_arc, std::size_t axis);
  static void cut_straight(const Segment& segment, const Axes& axes, double from, double to, const CellPlace& place);
  static void cut_curve(const Segment& segment, const Axes& axes, const Place& in, const Place& out,
                        const CellPlace& place);
  double graded(double size, double left) const;

  Axes limited_;  // all axes that have a limit
  Axes moving_;   // those of them that move on the segment
  const Segment* segment_ = nullptr;
  Place at_;             // up to where it is cut
  double longest_ = 0;   // cells in the middle
  double shortest_ = 0;  // and at the ends, from where they grow
  bool straight_ = false;
  double grade_ = 0;  // where limits fall with the speed: what each cell adds to the root of s, from a rest on
};

}  // namespace passo
