// TimeBound: the shortest time in which the planned path could be played within velocity, acceleration and feed.
//
// With x = ṡ² and u = s̈ = dx/ds / 2 every limit |q' u + q'' x| ≤ A is a strip of the plane (x, u). The path is cut
// into small cells. In each, x is a straight line and the limits are taken at the middle. Backwards from the end of a
// stretch: the largest x at each node from which the rest can still be played. Bisection finds it: is there an x at the
// next node that keeps every limit? Then forwards from rest, always as fast as allowed. A line is a single, exact cell:
// speed up, go on, brake. Where a limit falls with the speed, A is taken at the speed in the middle of each cell, and a
// line is cut like a curve, with shorter cells at its ends. Pfeiffer and Johanni 1987; Pham and Pham 2018
// (reachability).
//
// The path rests where the program demands it: at actions, exact stops and the ends, and where the direction jumps by
// more than rounding. Memory: a window of cells, many braking distances long. Motion after the window is assumed to be
// as fast as its first cell allows, so the result stays a lower bound of the time.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "exact_curve.hpp"
#include "speed_limit.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class TimeBound {
 public:
  explicit TimeBound(const ProofOptions& options);

  void watch(const PlannedMove& move);
  void rest(Seconds dwell);

  Seconds time() const { return Seconds(time_); }

 private:
  using Row = std::array<double, max_motors>;  // one number for each axis
  struct Cell {
    double length = 0;
    double entry_cap = 0;  // limit of x by velocity, feed and curvature, at its start and at the end of the cell before
    double entry_scale = 1;  // x at its start divided by x at the end of the cell before
    double exit_cap = 0;
    bool line = false;
    Row first{};  // q' and q'' at the cell's middle
    Row second{};
    double controllable = 0;  // the largest x at its start from which the path can be played
  };
  struct Joint {  // the end of the last curve
    Row direction{};
    double steepness = 0;  // |q'|
    double cap = 0;
    bool stop = false;
  };
  struct Range {
    double low, high;
  };

  void add_curve(const Segment& segment);
  void add_cell(const ExactCurve& curve, double from, double to, double feed);
  void settle(std::size_t cells);
  void end_stretch();
  void plan_backwards(double last);

  Joint joint_at(const ExactCurve& curve, double s) const;
  double cap_at(const ExactCurve& curve, double s, double feed) const;
  double curvature_cap(const Row& first, const Row& second, double most) const;
  double kink_cap(const Joint& before, const Joint& after) const;
  // The range of the next x that the cell's limits allow after x.
  Range next_of(const Cell& cell, double x) const;
  Range next_under_falling(const Cell& cell, double x) const;
  int cells_of_line(const ExactCurve& curve, double feed) const;
  double entry_for(const Cell& cell, double exit) const;
  double exit_for(const Cell& cell, double entry, double most) const;
  double line_reach(const Cell& cell) const;
  static double time_of_line(const Cell& cell, double entry, double exit, double reach);

  std::vector<ProvenAxis> axes_;
  std::vector<SpeedLimit> limits_;
  bool any_falls_ = false;
  std::vector<Cell> cells_;
  std::optional<Joint> joint_;
  double x_ = 0;  // at the start of the first cell
  double time_ = 0;
  bool inside_curve_ = false;  // a part of the curve has come, but not its end
  Mm reached_{0};              // the length of the curve that has come
};

}  // namespace passo::proof
