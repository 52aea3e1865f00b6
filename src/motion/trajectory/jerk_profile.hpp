// JerkProfile: the motion over the cells of a window of the path, so that no axis exceeds its jerk either. Private to
// trajectory/.
//
// Each node between cells has a speed and an acceleration along the path (NodeState). A cell is played in two phases of
// constant jerk and of equal time, which lead from the state at its start to the state at its end.
//
//   1. A guess: a motion below all caps that brakes and speeds up gently.
//   2. JerkLift makes the guess nearly the fastest motion.
//   3. The phases are checked against every axis, just as they will be given. Cells that exceed a limit are lifted
//      again with a smaller share of the limits, together with the cells around them. Where that does not help, the
//      cells are too long for how fast the motion changes there: they are halved, and all begins again.
//   4. If that does not help, the motion is slowed as a whole. With every speed times f, accelerations get f² and jerks
//      f³ times as large. So limits can always be kept.
//
// A window that begins in motion cannot be slowed at its start. Then the plan before goes on, which was checked and
// ends at rest. So no plan is given that was not found good.
//
// The window begins at rest or in motion, and ends at rest. If the path goes on after the window, only cells are
// decided that come well before the place where the motion begins to brake for the window's end.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "jerk_cell.hpp"
#include "jerk_lift.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo {

// How much is tried before the motion is slowed as a whole.
struct PlanEffort {
  int rounds = 10;   // cells that exceed a limit are lifted again so often
  int attempts = 6;  // each with more cells
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

  // Makes an empty profile begin in that state, in motion.
  void begin_in_motion(const NodeState& state);
  // Adds a cell, which takes one shape for each axis.
  void push(const JerkCell& cell, const AxisShape* shapes);
  // The square of the highest speed at which the last cell may be entered.
  double last_cap() const { return entry_cap_.back(); }
  // Plans all cells to rest at the end. Returns how many cells at the front are decided. All are if the window is
  // `closed` (the path does rest at its end).
  std::size_t plan(bool closed);
  // Adds the phases of a planned cell, at most two.
  void add_phases(std::size_t i, PlannedMove& move) const;
  // Forgets the first `count` cells, which have been given.
  void drop(std::size_t count);

  // The number of cells at the front that have a plan to rest at their end.
  std::size_t planned() const { return planned_; }
  // Whether the last plan() found nothing better than to go on with the plan before.
  bool fell_back() const { return fell_back_; }

 private:
  static constexpr std::size_t fewest_cells = 4;

  struct Excess {  // as multiples of the limits
    double force = 0;
    double jolt = 0;
    double pace = 0;  // the square of the speed, which a cap limits
    double most() const { return std::max({force, jolt, pace}); }
  };
  struct Stretch {  // from node to node
    std::size_t first = 0;
    std::size_t last = 0;
  };
  struct Inside {  // a place inside a phase
    NodeState state;
    double way = 0;  // from the start of the phase
  };

  AxisShape* shapes(std::size_t i) { return &shapes_[i * axes_.size()]; }
  const AxisShape* shapes(std::size_t i) const { return &shapes_[i * axes_.size()]; }

  double velocity_cap(std::size_t cell, double (*slope)(const AxisShape&, double length)) const;
  double acceleration_at(std::size_t cell, double x) const;
  double passing_cap(std::size_t node) const;
  double constant_speed_cap(std::size_t node) const;
  void prepare();
  void split(std::size_t i);
  void even_out();
  void grade();
  bool split_coarse();
  void guess(double share, double growth);
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
  void check_half(std::size_t i, std::uint32_t axes, const NodeState& start, double jerk, double time, double way,
                  int parts, Excess& worst) const;
  static Inside inside(const NodeState& from, double jerk, double time);
  static bool is_possible(const PhasePair& pair, const NodeState& from);
  static double highest(const NodeState& from, double jerk, double time);  // speed within a phase, without its end

  std::vector<LimitedAxis> axes_;
  bool any_falls_;
  PlanEffort effort_;
  std::vector<JerkCell> cells_;
  std::vector<AxisShape> shapes_;
  std::vector<double> entry_cap_;  // for each cell, squared: for a guess
  // For each node: one more than cells.
  std::vector<NodeState> states_;
  std::vector<NodeState> kept_;      // those of the plan before
  std::vector<double> passing_cap_;  // squared: by feed, velocities and jumps of the bend
  std::vector<double> node_cap_;     // the same, or lower where the motion exceeded it
  std::vector<double> cell_cap_;     // for each cell
  std::vector<double> share_;        // of the limits to lift to, for each cell
  std::vector<double> guess_;        // squared
  std::vector<bool> steady_;         // for each node: passed at the cap without acceleration
  std::vector<std::size_t> exceeded_;
  std::vector<Stretch> again_;  // stretches to lift once more
  bool in_motion_ = false;      // the window begins in motion, in the first of the states
  std::size_t planned_ = 0;     // cells for which the states are a plan to rest
  bool fell_back_ = false;
  JerkLift lift_;
};

}  // namespace passo
