// JerkProfile: the entry speed of each cell of a window of the path, so that no axis exceeds its jerk either. Private
// to trajectory/.
//
// Over the way s the square x = v² of the speed is a chain of straight pieces, one for each cell. The slope of a piece
// is twice the acceleration. Where two pieces meet, the acceleration changes by jerk times the time from the middle of
// one piece to the middle of the other.
//
//   x  cap ____  /chord\ ____    Forwards: from every place, the acceleration rises no faster than the jerk allows.
//        \ /F  \/       \B  /    Backwards: the same for braking. The smaller of the two has no convex corner sharper
//         v               \v      than the jerk allows: it passes its lowest places without acceleration.
//   ----------------------- s    Concave corners are cut. Add up the greatest drops of the slope at each node: the
//                                profile below them is then a convex hull, found in linear time (chords).
//
// The decided part of that is then raised (JerkLift, jerk_raise.cpp). The acceleration may fall while the motion enters
// a bend and rise while it leaves. The caps, which assume a constant speed, do not see that.
//
// The phases are then checked against every axis, just as they will be given. Where a limit is exceeded, the speed is
// lowered and the window planned again. Where that does not help, the last plan goes on, which was checked and ends at
// rest. From rest the window is slowed as a whole. So no plan is given that was not found good.
//
// The window ends at rest, or is planned as if it did. At some place braking does not limit the speed, and the profile
// goes on unchanged whatever comes. Such a place decides all cells before it.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "jerk_cell.hpp"
#include "jerk_lift.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo {

class JerkProfile {
 public:
  // `most_repairs` of a plan are tried before it is slowed as a whole.
  explicit JerkProfile(const std::vector<LimitedAxis>& axes, int most_repairs = 80)
      : axes_(axes),
        any_falls_(std::ranges::any_of(axes, [](const LimitedAxis& axis) { return axis.falling != nullptr; })),
        most_repairs_(most_repairs),
        lift_(axes) {}

  std::size_t size() const { return cells_.size(); }
  const JerkCell& cell(std::size_t i) const { return cells_[i]; }

  // Makes an empty profile begin at that speed, without acceleration.
  void begin_in_motion(double speed);
  // Adds a cell. `at_rest` means that it begins at rest.
  void push(const JerkCell& cell, const AxisShape* shapes, bool at_rest);
  // The square of the highest speed at which the last cell may be entered.
  double last_cap() const { return entry_cap_.back(); }
  // Plans all cells to rest at the end. Returns how many cells at the front are decided. All are if the window is
  // `closed` (the path does rest at its end).
  std::size_t plan(bool closed);
  // Adds the phases of a decided cell, at most two.
  void add_phases(std::size_t i, PlannedMove& move) const;
  // Forgets the first `count` cells, which have been given.
  void drop(std::size_t count);

  // The number of cells at the front that have a plan to rest at their end.
  std::size_t planned() const { return planned_; }

  // Whether the last plan() found nothing better than to go on with the plan before.
  bool fell_back() const { return fell_back_; }

 private:
  static constexpr double planned_velocity = 0.9999;  // a share of the limit

  struct Range {
    double low, high;
  };
  using State = NodeState;
  struct Pair {  // the two phases of a cell, each of half the time
    double half = 0;
    double first = 0;  // the jerk of the first phase
    double second = 0;
    State middle;
  };

  AxisShape* shapes(std::size_t i) { return &shapes_[i * axes_.size()]; }
  const AxisShape* shapes(std::size_t i) const { return &shapes_[i * axes_.size()]; }
  double slope(std::size_t i) const { return (x_[i + 1] - x_[i]) / (2 * cells_[i].length); }
  double duration(std::size_t i) const;

  void widen(Range& range, std::size_t cell, bool at_end, double v, double a) const;
  Range jerk_range(std::size_t node, double v, double a) const;
  double most_acceleration(std::size_t i, bool backwards, double near) const;
  double most_under_falling(std::size_t i, bool backwards, double near) const;
  struct March {
    double x = 0;
    double slope = 0;  // of the cell before
    double half = 0;   // half the time of the cell before
    bool operator==(const March&) const = default;
  };
  bool step(std::size_t i, bool backwards, March& march) const;
  void go_forwards();
  std::size_t go_backwards(bool closed);
  void cut_corners();
  void find_drops(std::size_t from);
  double drop_at(std::size_t node) const;
  State state(std::size_t node) const { return is_raised_ ? states_[node] : planned_state(node); }
  State planned_state(std::size_t node) const;
  Pair pair_of(std::size_t i) const;
  void add_steady(const JerkCell& cell, const State& from, double exit, PlannedMove& move) const;
  struct Excess {      // as multiples of the limits
    double force = 0;  // speed and acceleration
    double jolt = 0;
  };
  Excess excess(std::size_t i) const;
  void look_at_half(std::size_t i, const State& start, double jerk, double time, double way, int parts,
                    Excess& worst) const;
  struct Inside {  // a place inside a phase
    State state;
    double way = 0;  // from the start of the phase
  };
  static Inside inside(const State& from, double jerk, double time);
  static bool is_possible(const Pair& pair, const State& from);
  static double highest(const State& from, double jerk, double time);  // speed within a phase, without its end
  bool lower_where_exceeded(int round);
  void slow_down();
  void level(std::size_t begin, std::size_t end);
  std::size_t go_on_as_planned();
  void prepare();
  void split(std::size_t i);
  void refine();
  void even_out();
  void flatten(std::size_t i);
  bool is_as_checked(std::size_t i) const;
  bool is_calm(std::size_t node) const;
  void find_passing_caps();
  void raise(std::size_t last);
  void find_fixed(std::size_t last);
  void raise_between(std::size_t first, std::size_t last);
  struct Stretch {  // from node to node
    std::size_t first = 0;
    std::size_t last = 0;
  };
  void find_raised_too_far(const Stretch& raised);
  void put_back(std::size_t first, std::size_t last);

  std::vector<LimitedAxis> axes_;
  bool any_falls_;
  int most_repairs_;
  std::vector<JerkCell> cells_;
  std::vector<AxisShape> shapes_;
  std::vector<double> entry_cap_;    // for each cell
  std::vector<double> entry_share_;  // share of the jerk to plan with, where the cell begins
  // For each node: one more than cells.
  std::vector<double> cap_;
  std::vector<double> share_;
  std::vector<March> forwards_;
  std::vector<March> backwards_;
  std::vector<double> raised_;  // x_ plus the sum of the drops
  std::vector<double> uncut_;   // x_ before its corners were cut
  // The nodes at which a repair lowered something. The plan is made anew only from there on.
  struct Changed {
    bool all = true;
    std::size_t from = 0;
    std::size_t to = 0;
  };
  Changed changed_;
  std::vector<double> x_;
  std::vector<double> checked_;  // x_ at the last check of the limits
  std::vector<std::size_t> exceeded_;
  std::vector<double> drops_;
  std::vector<double> place_;
  static constexpr std::size_t cannot_brake = static_cast<std::size_t>(-1);
  std::vector<std::size_t> hull_;
  std::size_t frozen_ = 0;   // cells at the front whose x is fixed
  State start_;              // state at the front, given before
  std::size_t planned_ = 0;  // cells for which x_ is a plan to rest
  std::vector<double> kept_;
  bool fell_back_ = false;

  // Motion raised above x_. Where it exists, the states are played.
  JerkLift lift_;
  std::vector<double> passing_cap_;  // for each node
  std::vector<bool> jumps_;          // the bend jumps at the node and limits the speed
  std::vector<bool> fixed_;
  std::vector<double> lift_share_;  // share of the limits, for each cell
  std::vector<double> lift_cap_;
  std::vector<State> states_;
  std::vector<State> unraised_;
  std::vector<Stretch> again_;  // stretches to raise once more
  bool is_raised_ = false;
};

}  // namespace passo
