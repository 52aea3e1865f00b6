// Cell: a short part of a segment with constant acceleration along the path. Private to trajectory/.
//
// Let q(s) be the position of an axis on the path, s the distance and v the speed along the path. The axis accelerates
// by
//
//     q' a + q'' v²          a = dv/dt
//
// and must stay within its limit. Where a is constant, v² is linear in s: from x at the cell's entry to y at its exit,
// with a = (y - x) / 2h. The acceleration demand of an axis at either end is then linear in x and y. Between the ends
// the demand is higher by at most a slack, which is subtracted from the limit beforehand (cell.cpp). So a constraint
// that holds at both ends holds in the whole cell.
//
// Source: the linear constraints of time-optimal path following (Bobrow, Dubowsky, Gibson 1985) in the form of H. Pham,
// Q.-C. Pham, "A new approach to time-optimal path parameterization based on reachability analysis" (2018).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "limited_axis.hpp"

#include "passo/path/segment.hpp"

namespace passo {

// In mm. A stop within a cell leaves at least this length of the cell, so that the remainder can be halved down to
// rounding errors. Less if an axis turns so far per micrometre that this would take long: the distance covered in this
// time in seconds at the axes' velocities.
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

// The demand of an axis whose limit falls with its speed. In the cell, the square of the axis' speed is about
// entry_weight x at the entry and exit_weight y at the exit. For any line of the curve, if at both ends
//
//     |demand| + fall w <= at_rest - slack - fall slack_of_fall
//
// holds, the axis is within the curve in the whole cell.
struct FallingDemand {
  const AccelerationCurve* curve = nullptr;
  std::uint32_t demand = 0;  // the index of this axis' demand among the cell's demands
  std::uint32_t line = 0;    // the line of the curve with which the cell was last found feasible
  double entry_weight = 0;
  double exit_weight = 0;
  double slack = 0;
  double slack_of_fall = 0;
};

struct Cell {
  double start = 0;                      // s on the segment's curve
  double end = 0;                        // in the last cell exactly the curve's length
  double length = 0;                     // end - start, above 0
  double top_squared = 0;                // the limit by the axes' velocities, for the whole cell
  double acceleration = 0;               // the maximum along the path, in either direction
  double smallest_rest = smallest_cell;  // minimum remainder of the cell after a stop
  bool straight = false;                 // uses exactly this acceleration; may accelerate and decelerate within the
                                         // cell
  std::uint8_t demand_count = 0;
  std::uint8_t falling_count = 0;
};

// A cell and the storage for its demands, with room for one demand of each axis.
struct CellPlace {
  Cell& cell;
  AxisDemand* demands;
  FallingDemand* falling;

  // Allows a cell that was cut again the motion that was planned in the longer cell. The demands at the ends of a cell
  // leave room for the slack between them, so in the middle of a cell an axis may demand more.
  void allow(double entry, double exit) const;
};

// Divides segments into cells. A straight cell is a whole segment, and its only demand is its acceleration. Lines are
// divided like curves if the motion may be fast enough for a limit to fall. About 100 ns for a cell of a cubic with
// three axes.
class CellCutter {
 public:
  // `limits` must outlive the cutter.
  explicit CellCutter(const MotionLimits& limits);
  // The maximum number of demands of one cell, and of those that fall with the speed.
  std::size_t most_demands() const;
  std::size_t most_falling() const;

  // Begins a segment, which must stay at its address, at its start or later. `entry_squared` is the maximum squared
  // speed there. next() then returns the cells in order, up to the segment's end.
  void begin(const Segment& segment, double entry_squared, double from = 0);
  bool at_end() const { return !(at_.s < segment_->curve.length().value()); }
  void next(const CellPlace& to);
  // Cuts one cell of another segment: the remainder of a cell that was partly returned, straight or not.
  void cut(const Segment& segment, double from, double to, bool straight, const CellPlace& place) const;

 private:
  using Axes = std::vector<LimitedAxis>;
  template <class Value>
  using PerLimit = std::array<Value, most_limited_axes>;  // one value per limited axis, in their order
  // A point on the curve. The end of one cell is the start of the next, so each point is computed once.
  struct Place {
    double s = 0;
    double turning = 0;  // square of the highest speed at which the axes together allow this bend
    double around = 0;   // on an arc: the size of the slope in the arc's plane
    PerLimit<double> slope;
    PerLimit<double> bend;
  };
  // Upper bounds of |q'''| and |q''''| between two points.
  struct Bend {
    double third = 0;
    double fourth = 0;
  };
  struct CellBounds {
    const PerLimit<Bend>& bends;
    double top_squared = 0;      // the limit by the axes
    double fastest_squared = 0;  // the limit by the axes and the feed
  };
  struct Strength {  // the maximum acceleration along the path
    double most = 0;
    bool is_kept = false;  // true: the axes' own limits guarantee it, at any speeds
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
  // For each moving axis, constant over the segment: a cubic's |q'''|, or the axis' component of an arc's bend.
  PerLimit<double> shares_;
  Place at_;             // the segment is cut up to here
  double longest_ = 0;   // length of cells in the middle
  double shortest_ = 0;  // length of the cells at the ends; the following cells grow
  bool straight_ = false;
  double grade_ = 0;  // where limits fall with the speed: each cell adds this to the square root of s, starting at a
                      // stop
};

}  // namespace passo
