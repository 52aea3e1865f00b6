// TimeBound: a lower bound for the time of any motion on the planned path within velocity, acceleration, jerk and feed
// limits.
//
// With x = ṡ² each axis has q̇² = q'² x. The path is divided into small cells. In each cell every axis moves only in
// one direction, and its |q'| only rises or only falls. From one end of a cell to the other, the change of q̇² is
// limited by the axis' acceleration over its own distance |Δq|: q'₁² x₁ − q'₀² x₀ is within ± 2 A |Δq|, independent of
// x in between (AxisRamp; also where the limit falls with the speed). So the largest x at one end gives the largest x
// at the other end, without discretisation error: backwards from the end of a section, then forwards from a stop.
//
// Two bounds hold at a single point. An axis' velocity limits x, and so does the bend of the path: if x is too large,
// two axes leave no s̈ that keeps the acceleration q' s̈ + q'' x of both within its limit (turning_at).
//
// A cell takes at least the time that any of its axes needs for its own distance, with the speeds found at its ends,
// and at least the time of the whole cell at the largest x in it. The only inaccuracy is that different axes may limit
// the motion in different parts of a cell; so the bound can be slightly too small, and never too large.
//
// Jerk limits raise the bound where an axis, or a straight line, moves from one point to another (JerkTimeBound), and
// where the path bends (time_bound_turns.cpp).
//
// The path stops where the program requires it: at actions, exact stops and the ends, and where the direction jumps by
// more than rounding. There x is limited by the start-stop velocities of the axes. Memory: a window of cells, many
// braking distances long. Motion after the window is assumed to be as fast as its first cell allows.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "axis_ramp.hpp"
#include "exact_curve.hpp"
#include "jerk_time_bound.hpp"
#include "speed_limit.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class TimeBound {
 public:
  TimeBound(const ProofOptions& options, const std::vector<SpeedLimit>& limits);

  // `curve` is that of the move, which has a length and phases.
  void watch(const PlannedMove& move, const ExactCurve& curve);
  void rest(Seconds dwell);

  Seconds time() const { return Seconds(time_); }

 private:
  static constexpr double fastest = 1e12;      // x without a limit
  using Row = std::array<double, max_motors>;  // one number per axis
  using Pairs = std::array<double, std::size_t{max_motors} * (max_motors - 1) / 2>;
  struct Place {
    double s = 0;
    Row slope{};      // q'
    Row bend{};       // q''
    Pairs turning{};  // for each pair of axes: 1/x of the largest x, with the sign of the turn
    Pairs turn{};     // q''ᵢ q'ⱼ − q''ⱼ q'ᵢ of each pair
    double cap = 0;   // the largest x here
  };
  struct End {       // end of a cell
    double cap = 0;  // the largest x there
    Row slope{};     // q'²
  };
  struct Cell {
    double length = 0;
    double cap = 0;  // the largest x anywhere in it
    End entry;       // its cap also applies at the end of the previous cell
    End exit;
    double entry_scale = 1;   // x at its start divided by x at the end of the previous cell
    double controllable = 0;  // the largest x at its start from which the rest of the path is possible
    double standing = 0;      // an axis with a smaller q'² does not move, except for rounding
    Row way{};                // Δq
  };
  // Two axes. turning_pairs_ has those that both have a jerk limit.
  struct AxisPair {
    std::size_t i = 0;
    std::size_t j = 0;
    std::size_t place = 0;  // index among all pairs
  };
  // The motion of such a pair in a cell. T is |q''ᵢ q'ⱼ − q''ⱼ q'ᵢ|, and T ṡ³ changes along the path.
  struct Turn {
    double entry = 0;   // T at the cell's start
    double exit = 0;    // T at its end
    double least = 0;   // T
    double change = 0;  // the largest change in the cell
    // The largest rounding change at the cell's start: jump ṡ + kink.
    double jump = 0;
    double kink = 0;
  };
  struct Joint {  // the end of the last curve
    Place place;
    Row direction{};
    double steepness = 0;  // |q'|
    double rest_cap = 0;   // the largest x with which the path can end here
  };

  void add_curve(const Segment& segment, const ExactCurve& curve);
  void add_cells(const ExactCurve& curve, const Place& from, const Place& to, double feed);
  void add_cell(const ExactCurve& curve, const Place& from, const Place& to, double feed);
  static double least_through(double first, double second, double third);
  void find_turning_pairs();
  void add_turns(const ExactCurve& curve, const Place& from, const Place& middle, const Place& to);
  Turn jump_of(const AxisPair& pair, const Place& start) const;
  double bend_cap(const Place& before, const Place& after, double scale) const;
  void add_jumps(std::size_t cell, const Place& start);
  const Turn& turn_of(std::size_t cell, std::size_t pair) const { return turns_[cell * turning_pairs_.size() + pair]; }
  double turn_at_entry(std::size_t cell, std::size_t pair) const;
  double turn_at_exit(std::size_t cell, std::size_t pair) const;
  double turn_at_joint(std::size_t cell, std::size_t pair) const;
  bool lower_where_it_turns(double at_end);
  void lower_caps(double at_end, bool rests);
  double exit_of(std::size_t cell, double entry, double at_end) const;
  void settle(std::size_t cells);
  void end_stretch(bool steady = true);
  void raise_by_line(bool steady);
  void add_to_line(const Segment& segment, const Place& place);
  bool goes_back(const Joint& before, const Joint& after) const;
  JerkTimeBound::Rides rides_in(const Cell& cell, double entry, double exit) const;
  void plan_backwards(double last);

  double cells_in(const ExactCurve& curve, const Place& start, double feed) const;
  Place place_at(const ExactCurve& curve, double s, double feed) const;
  Place place_of_turn(const ExactCurve& curve, const Place& from, const Place& to, std::size_t axis, bool bend) const;
  double turning_at(const Place& place, const AxisPair& pair, double enough) const;
  double cap_within(const Place& from, const Place& middle, const Place& to) const;
  Joint joint_at(const Place& place) const;
  double kink_cap(const Joint& before, const Joint& after) const;
  double rest_cap(const Place& place) const;
  double most_at(const End& end, const End& other, double at_other, const Cell& cell) const;
  double least_time(const Cell& cell, double entry, double exit) const;

  std::vector<ProvenAxis> axes_;
  std::vector<Axis> letters_;
  std::vector<SpeedLimit> limits_;
  std::vector<AxisRamp> ramps_;
  bool any_falls_ = false;
  bool any_jumps_ = false;  // some axis has a start-stop velocity
  std::vector<AxisPair> turning_pairs_;
  std::vector<Cell> cells_;
  std::vector<Turn> turns_;  // for each cell, one for each of those pairs
  std::optional<Joint> joint_;
  double x_ = 0;  // at the start of the first cell
  double time_ = 0;
  JerkTimeBound ways_;
  // The section as long as it is a single straight line. Its limits are those along the line.
  struct Line {
    double began = 0;  // the bound of the time up to its start
    bool steady = true;
    std::size_t curves = 0;
    Row direction{};
    double length = 0;
    double top = 0;
    double acceleration = 0;
    double jerk = 0;
  };
  std::optional<Line> line_ = Line();  // empty: the section is not straight
  double length_ = 0;                  // of the last curve
  Mm reached_{0};                      // and how far the motion has come on it
};

}  // namespace passo::proof
