// JerkProfile: plans the motion over the cells of a window of the path, within the jerk limits of all axes. Private to
// trajectory/.
//
// Each node between cells has a speed and an acceleration along the path (NodeState). A cell is executed in two phases
// of constant jerk and equal time, which lead from the state at its start to the state at its end.
//
//   1. A guess: a motion below all speed limits that accelerates and decelerates gently.
//   2. JerkOptimizer optimises the guess to nearly the fastest motion.
//   3. The phases are checked against every axis, exactly as they will be returned. Cells that exceed a limit are
//      optimised again with a smaller fraction of the limits, together with the cells around them. If that does not
//      help, the cells are too long for the rate of change of the motion: they are halved, and planning starts again.
//   4. If that does not help, the motion is slowed as a whole. If every speed is multiplied by f, accelerations change
//      by f² and jerks by f³. So the limits can always be kept.
//
// A window that begins in motion cannot be slowed at its start. Then the previous plan continues, which was checked and
// ends in a stop. So no unchecked plan is used.
//
// The window begins at a stop or in motion, and ends in a stop. If the path continues after the window, only cells are
// decided that come well before the point where the motion begins to decelerate for the window's end.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "jerk_cell.hpp"
#include "jerk_optimizer.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo {

// The effort before the motion is slowed as a whole.
struct PlanEffort {
  int rounds = 10;   // maximum number of times that cells beyond a limit are optimised again
  int attempts = 6;  // each attempt uses more cells
  std::size_t most_cells = std::numeric_limits<std::size_t>::max();  // then they are no longer split; set by plan()
};

class JerkProfile {
 public:
  explicit JerkProfile(const std::vector<LimitedAxis>& axes, const PlanEffort& effort = {})
      : axes_(axes),
        any_falls_(std::ranges::any_of(axes, [](const LimitedAxis& axis) { return axis.falling != nullptr; })),
        effort_(effort),
        lift_(axes) {}

  std::size_t size() const { return cells_.size(); }
  const JerkCell& cell(std::size_t i) const { return cells_[i]; }

  // Sets the start of an empty profile to that state, in motion.
  void begin_in_motion(const NodeState& state);
  // Sets the start of an empty profile to a stop. The motion may begin at once with at most that speed (squared).
  void begin_at_stop(double most_squared) { ends_.start_squared = most_squared; }
  // Adds a cell, with one shape per axis.
  void push(const JerkCell& cell, const AxisShape* shapes);
  // Returns the square of the highest entry speed of the last cell.
  double last_cap() const { return entry_cap_.back(); }
  // Plans all cells to a stop at the end. Returns the number of decided cells at the front: all if the window is
  // `closed` (the path does stop at its end). `end_squared`: the greatest speed (squared) that may be left at the stop.
  std::size_t plan(bool closed, double end_squared = 0);
  // Adds the phases of a planned cell, at most two.
  void add_phases(std::size_t i, PlannedMove& move) const;
  // Drops the first `count` cells, which have been returned.
  void drop(std::size_t count);

  // The number of cells at the front that have a plan to a stop at their end.
  std::size_t planned() const { return planned_; }
  // Whether the last plan() could only continue the previous plan.
  bool fell_back() const { return fell_back_; }

 private:
  static constexpr std::size_t fewest_cells = 4;
  static constexpr double planned_velocity = 0.9999;  // a share of the limits

  struct Excess {  // as multiples of the limits
    double force = 0;
    double jolt = 0;
    double pace = 0;  // the square of the speed, relative to its limit
    double most() const { return std::max({force, jolt, pace}); }
  };
  struct Stretch {  // from node to node
    std::size_t first = 0;
    std::size_t last = 0;
  };
  struct Inside {  // a point inside a phase
    NodeState state;
    double way = 0;  // distance from the start of the phase
  };

  AxisShape* shapes(std::size_t i) { return &shapes_[i * axes_.size()]; }
  const AxisShape* shapes(std::size_t i) const { return &shapes_[i * axes_.size()]; }

  double velocity_cap(std::size_t cell, double (*slope)(const AxisShape&, double length)) const;
  double acceleration_at(std::size_t cell, double x) const;
  double passing_cap(std::size_t node) const;
  double constant_speed_cap(std::size_t node) const;
  JerkOptimizer::Stop stop_at(bool begins) const;
  void prepare();
  void split(std::size_t i);
  void even_out();
  void grade();
  bool split_coarse();
  void guess(double share, double growth);
  double most_at_start() const;
  void guess_from(std::size_t node, bool backwards, double growth);
  void begin_with_guess();
  double duration(std::size_t i) const;
  double time() const;
  void find_steady();
  double narrow_steady(std::size_t node, std::size_t cell, double left);
  bool lift_between_steady();
  bool lift_wider(Stretch& part);
  bool find_motion();
  bool find_motion_from_slow();
  bool lift(const Stretch& stretch);
  bool mend();
  bool trim(std::size_t i, const Excess& worst, const Stretch& lifted);
  void find_exceeded(const Stretch& lifted);
  double slowing() const;
  void slow_by(double factor);
  bool slow_down();
  std::size_t go_on_as_planned(bool again);
  std::size_t decided_of_open() const;

  PhasePair pair_of(std::size_t i) const;
  void add_steady(const JerkCell& cell, const NodeState& from, double exit, PlannedMove& move) const;
  Excess excess(std::size_t i) const;
  std::uint32_t axes_near_limits(std::size_t i, const NodeState& most, double jerk) const;
  bool turns_much(std::size_t i, std::uint32_t axes) const;
  void check_half(std::size_t i, std::uint32_t axes, const NodeState& start, double jerk, double time, double way,
                  std::size_t parts, Excess& worst) const;
  static Inside inside(const NodeState& from, double jerk, double time);
  static bool is_possible(const PhasePair& pair, const NodeState& from);
  // maximum speed within a phase, without its end
  static double highest(const NodeState& from, double jerk, double time);

  std::vector<LimitedAxis> axes_;
  bool any_falls_;
  PlanEffort effort_;
  std::vector<JerkCell> cells_;
  std::vector<AxisShape> shapes_;
  std::vector<double> entry_cap_;  // for each cell, squared: for the guess
  // For each node: one more than cells.
  std::vector<NodeState> states_;
  std::vector<NodeState> kept_;      // those of the previous plan
  std::vector<double> passing_cap_;  // squared: by feed, velocities and jumps of the bend
  std::vector<double> node_cap_;     // the same, or lower where the motion exceeded it
  std::vector<double> cell_cap_;     // for each cell
  std::vector<double> share_;        // fraction of the limits for the optimisation, for each cell
  std::vector<double> guess_;        // squared
  std::vector<bool> steady_;         // for each node: passed at the speed limit without acceleration
  std::vector<std::size_t> exceeded_;
  std::vector<Stretch> again_;  // sections to optimise again
  // The ends of the window.
  struct Ends {
    bool in_motion = false;    // the window begins in motion, in the first of the states
    double start_squared = 0;  // at a stop: the greatest speed to begin with
    double end_squared = 0;    // and the greatest one left at the end
  };
  Ends ends_;
  std::size_t planned_ = 0;  // cells for which the states are a plan to a stop
  bool fell_back_ = false;
  JerkOptimizer lift_;
};

}  // namespace passo
