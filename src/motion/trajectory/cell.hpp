// Cell: a short part of a segment with constant acceleration along the path. Private to trajectory/.
//
// Let q(s) be the place of an axis on the path, s the way and v the speed along the path. The axis accelerates by
//
//     q' a + q'' v²          a = dv/dt
//
// and must stay within its limit. Where a is constant, v² is a straight line over s: from x at the cell's entry to y at
// its exit, with a = (y - x) / 2h. What an axis demands at either end is then linear in x and y. Between the ends the
// demand is higher by no more than a slack, which is taken off the limit beforehand (cell.cpp). So what holds at both
// ends holds in the whole cell.
//
// Source: the linear constraints of time-optimal path following (Bobrow, Dubowsky, Gibson 1985) in the form of
// H. Pham, Q.-C. Pham, "A new approach to time-optimal path parameterization based on reachability analysis" (2018).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "limited_axis.hpp"

#include "passo/path/segment.hpp"

namespace passo {

// In mm. A stop within a cell leaves at least this much of the cell, so that the rest can be halved down to what is
// rounding. Less where an axis turns so far in a micrometre that this would be long: what takes so many seconds at the
// axes' velocities.
inline constexpr double smallest_cell = 1e-6;
inline constexpr double shortest_cell = 1e-4;

// The demand of one axis on the squares of the speeds at the cell's ends:
// |entry_x x + entry_y y| <= limit and |exit_x x + exit_y y| <= limit.
struct AxisDemand {
  double entry_x = 0;
  double entry_y = 0;
  double exit_x = 0;
  double exit_y = 0;
  double limit = 0;
};

// One demand for each axis, and one for the acceleration along the path.
inline constexpr std::size_t most_demands_of_cell = most_limited_axes + 1;

// The demand of an axis whose limit falls with its speed. In the cell, the square of the axis's speed is about
// entry_weight x at the entry and exit_weight y at the exit. Take any line of the curve; where at both ends
//
//     |demand| + fall w <= at_rest - slack - fall slack_of_fall
//
// holds, the axis keeps to the curve in the whole cell.
struct FallingDemand {
  const AccelerationCurve* curve = nullptr;
  std::uint32_t demand = 0;  // the index of the axis's own demand among the cell's demands
  std::uint32_t line = 0;    // the curve's line with which the cell was last found possible
  double entry_weight = 0;
  double exit_weight = 0;
  double slack = 0;
  double slack_of_fall = 0;
};

struct Cell {
  double start = 0;                      // s on the segment's curve
  double end = 0;                        // in the last cell exactly the curve's length
  double length = 0;                     // end - start, above 0
  double top_squared = 0;                // the limit by the axes' velocities, anywhere in the cell
  double acceleration = 0;               // the greatest along the path, either way
  double smallest_rest = smallest_cell;  // that a stop leaves of the cell
  bool straight = false;                 // uses just this acceleration; may speed up and brake within the cell
  std::uint8_t demand_count = 0;
  std::uint8_t falling_count = 0;
};

// A cell and the storage for its demands, with room for one demand of each axis.
struct CellPlace {
  Cell& cell;
  AxisDemand* demands;
  FallingDemand* falling;

  // Allows a cell that was cut again what was planned for it in the longer cell: the demands at the ends of a cell
  // leave room for what lies between them, so in the middle of a cell an axis may demand more.
  void allow(double entry, double exit) const;
};

// Cuts segments into cells. A straight cell is a whole segment, and its only demand is its acceleration. Lines are cut
// like curves if the motion may be so fast that a limit falls. About 100 ns for a cell of a cubic with three axes.
class CellCutter {
 public:
  // `limits` must outlive the cutter.
  explicit CellCutter(const MotionLimits& limits);
  // The most demands of one cell, and the most of them that fall with the speed.
  std::size_t most_demands() const;
  std::size_t most_falling() const;

  // Begins a segment, which must stay where it is, at its start or later. `entry_squared` is the greatest square of the
  // speed there. next() then gives the cells in order, up to the segment's end.
  void begin(const Segment& segment, double entry_squared, double from = 0);
  bool at_end() const { return !(at_.s < segment_->curve.length().value()); }
  void next(const CellPlace& to);
  // Cuts one cell of another segment: the rest of a cell that was given in part, straight or not.
  void cut(const Segment& segment, double from, double to, bool straight, const CellPlace& place) const;

 private:
  using Axes = std::vector<LimitedAxis>;
  template <class Value>
  using PerLimit = std::array<Value, most_limited_axes>;  // of as many axes as there are, in their order
  // A place on the curve. The end of one cell is the start of the next, so each place is computed once.
  struct Place {
    double s = 0;
    double turning = 0;  // square of the highest speed at which all axes together can turn so
    double around = 0;   // on an arc: the size of the slope in the arc's plane
    PerLimit<double> slope;
    PerLimit<double> bend;
  };
  // Bounds of |q'''| and |q''''| between two places.
  struct Bend {
    double third = 0;
    double fourth = 0;
  };
  struct CellBounds {
    const PerLimit<Bend>& bends;
    double top_squared = 0;      // the limit by what the axes can do
    double fastest_squared = 0;  // the limit by the axes and by the feed
  };
  struct Strength {  // the greatest acceleration along the path
    double most = 0;
    bool is_kept = false;  // true: the axes' own limits keep it, at any speeds
  };
  static Strength strength_on(const Axes& axes, const Place& in, const Place& out, const CellBounds& bounds,
                              double slope_strength);
  static double part_of_turn(const Axes& axes, const Point& steepest);
  static double top_of_turning(const Axes& axes, const Place& place);
  static void find_place(const Curve& curve, const Axes& axes, double s, Place& place);
  static void find_shares(const Curve& curve, const Axes& axes, PerLimit<double>& shares);
  static Bend bend_of_arc(const Curve& curve, const Place& in, const Place& out);
  static void cut_straight(const Segment& segment, const Axes& axes, double from, double to, const CellPlace& place);
  static void cut_curve(const Segment& segment, const Axes& axes, const PerLimit<double>& shares, const Place& in,
                        const Place& out, const CellPlace& place);
  double graded(double size, double left) const;

  Axes limited_;  // all axes that have a limit
  Axes moving_;   // those of them that move on the segment
  const Segment* segment_ = nullptr;
  // Of each moving axis, the same all along the segment: a cubic's |q'''|, or the part of an arc's bend that it sees.
  PerLimit<double> shares_;
  Place at_;             // cut up to here
  double longest_ = 0;   // length of cells in the middle
  double shortest_ = 0;  // length of the cells at the ends; from there they grow
  bool straight_ = false;
  double grade_ = 0;  // where limits fall with the speed: each cell adds this to the root of s, from a rest on
};

}  // namespace passo
