// JerkOptimizer: optimises a motion over cells to nearly the minimum time. Private to trajectory/.
//
// Each node has the square x of the speed, and the acceleration a. Over each half of a cell a changes linearly with the
// distance. With m = (x1 - x0) / 2h that means
//
//     a in the middle = 2 m - (a0 + a1) / 2      x in the middle = (x0 + x1) / 2 + h (a0 - a1) / 4
//     j / v = (4 m - 3 a0 - a1) / h in the first half, (3 a1 + a0 - 4 m) / h in the second
//
// The demand of an axis is then linear in the four values at the ends of a cell, except for the jerk's factor v:
//
//     |q' a + q'' x| <= A        |q' j/v + 3 q'' a + q''' x| <= J / sqrt(x)
//
// The right side is a convex function of x. Its tangent lies below it, so a value within the tangent is allowed. The
// time is convex too. A primal-dual interior-point method with slacks solves the problem. Each step solves a system
// with seven diagonals, so its time grows linearly with the number of cells; about ten steps are enough. An infeasible
// start is brought back within the limits.
//
// The result must be checked: between the evaluated points, demands may be slightly larger.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "jerk_cell.hpp"
#include "phase_pair.hpp"

#include "passo/base/lanes.hpp"

namespace passo {

class JerkOptimizer {
 public:
  explicit JerkOptimizer(const std::vector<LimitedAxis>& axes) : axes_(axes) {}

  // A stop that the motion may leave, or reach, at any x up to `square`, with the acceleration `bend` x.
  struct Stop {
    double square = 0;  // 0: the speed at the stop is 0
    double bend = 0;
  };
  struct Stretch {
    const std::vector<JerkCell>& cells;
    const std::vector<AxisShape>& shapes;  // for each cell, one per axis
    const std::vector<double>& share;      // fraction of the limits to use, for each cell
    const std::vector<double>& cap;        // the maximum squared speeds, for each cell
    const std::vector<double>& node_cap;   // and for each node
    Stop begins = {};                      // the stop at `first`
    Stop ends = {};                        // and that at `last`
  };
  // Optimises the motion between the nodes `first` and `last`, which stay unchanged, except at a stop with a speed. If
  // the speed is 0 at one of them, the jerk is constant in the cell next to it; at all other nodes the speed must be
  // above 0. Returns false and changes nothing if no feasible motion was found.
  [[nodiscard]] bool raise(const Stretch& stretch, std::size_t first, std::size_t last, std::vector<NodeState>& states);

 private:
  using Four = std::array<double, 4>;  // factors of x0, a0, x1, a1
  // Both sides of a limit, the upper one first: the slack, and its multiplier.
  struct Sides {
    TwoLanes slack;
    TwoLanes by_slack;
    TwoLanes price;
    TwoLanes missing;       // the residual of the slack
    TwoLanes change;        // change of the slack in this step
    TwoLanes price_change;  // in this step
  };
  struct Row {  // |along * (x, a) - offset| <= limit
    Four along{};
    double offset = 0;
    double limit = 0;
    Sides sides = {};
  };
  // Points of a cell at which its jerk is limited.
  enum class At : std::uint8_t {
    in,
    middle,
    out,
    early,  // the point at which the speed is the mean speed of the first half
    late,
  };
  struct JoltRow {  // jerk constraint: |along * (x, a)| <= limit / sqrt(x at the point)
    Four along{};
    double limit = 0;
    At place = At::in;
    Sides sides = {};
  };
  struct Pace {
    Four square{};  // the form of x
    double by_square = 0;
    double by_speed = 0;
    // The decrease of a jerk limit with x.
    double fall() const { return 0.5 * by_square * by_speed; }
  };
  struct Cell {
    std::array<Pace, 5> paces{};  // by At; `early` and `late` only in straight cells
    std::size_t pace_count = 0;   // 0: the cell has a stop
    Four to_and_fro{};            // the form of the acceleration in the middle, less the mean of those at the ends
    double length = 0;
    std::size_t rows_end = 0;
    std::size_t jolt_rows_end = 0;

    bool has_rest() const { return pace_count == 0; }
    const Pace& pace(At place) const { return paces[static_cast<std::size_t>(place)]; }
  };
  // At a stop with a speed, and at the node next to a stop without, the acceleration follows from the speed: a =
  // factor x. So a is not a separate unknown.
  struct Tie {
    std::size_t node = 0;
    double factor = 0;
    bool holds = false;
  };
  bool is_tied(std::size_t node) const {
    return (tied_first_.holds && node == tied_first_.node) || (tied_last_.holds && node == tied_last_.node);
  }
  bool begins_free() const { return tied_first_.holds && tied_first_.node == 0; }
  bool ends_free() const { return tied_last_.holds && 2 * tied_last_.node + 2 == at_.size(); }
  // The numbers that move.
  std::size_t first_moved() const { return begins_free() ? 0 : 2; }
  std::size_t last_moved() const { return at_.size() - (ends_free() ? 0 : 2); }
  void tie(Four& along) const;
  void tie_step(const Tie& tied);

  void set_up(const Stretch& stretch, std::size_t first, std::size_t last, const std::vector<NodeState>& states);
  void make_passable(const Stretch& stretch, std::size_t first);
  void make_rows(const Stretch& stretch, std::size_t first, std::size_t last);
  void add_cell(const Stretch& stretch, std::size_t cell);
  void add_rows(const Stretch& stretch, std::size_t cell, bool is_first);
  struct Place {
    double weight = 0;  // factor from x to the square of the axis' speed
    double share = 0;   // fraction of the limits
    double x = 0;
    double cap = 0;  // the maximum x
  };
  void add_force_rows(const Row& row, const LimitedAxis& axis, const Four& x, const Place& place);
  void add_stop_row(const Four& x, const Stop& stop, double share);
  void add_straight_rows(const JerkCell& cell, double share, double in_share);
  void add_cell_at_rest(const Stretch& stretch, std::size_t cell, bool begins);
  double highest_beside_rest(const Stretch& stretch, std::size_t cell, bool begins) const;
  // The axes whose limits the motion can reach in a cell, one bit each.
  struct Binding {
    std::uint32_t force = 0;
    std::uint32_t jolt = 0;
  };
  Binding binding_in(const Stretch& stretch, std::size_t cell) const;
  void add_row(Row row);
  void add_tied_row(const Row& row);
  void add_jolt_row(JoltRow row);
  double begin_prices();
  template <class Visit>
  void measure(const Visit& visit);
  void assemble(double target);
  struct Block;
  void add_time(std::size_t c, Block& block);
  void add_to_system(std::size_t at, const Block& block);
  void solve();
  struct Reach {  // allowed fractions of the step
    double share = 0;
    double price_share = 0;
  };
  Reach reach_along(double target);
  double go(const Reach& reach);
  double time() const;
  bool is_allowed() const;

  std::vector<LimitedAxis> axes_;
  std::vector<double> at_;  // x and a of each node
  std::vector<Cell> cells_;
  std::vector<Row> rows_;
  std::vector<JoltRow> jolt_rows_;
  std::size_t rows_made_ = 0;
  std::size_t jolt_rows_made_ = 0;
  Tie tied_first_;
  Tie tied_last_;
  std::size_t cell_ = 0;          // the cell whose rows are being built, counted from the first
  const double* here_ = nullptr;  // x and a at its ends
  std::vector<Four> system_;      // the diagonal, and the three next to it
  std::vector<double> step_;
};

}  // namespace passo
