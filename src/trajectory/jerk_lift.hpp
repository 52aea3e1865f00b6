// JerkLift: makes a motion over cells nearly the fastest one. Private to trajectory/.
//
// Each node has the square x of the speed, and the acceleration a. Over each half of a cell a changes linearly with the
// way. With m = (x1 - x0) / 2h that means
//
//     a in the middle = 2 m - (a0 + a1) / 2      x in the middle = (x0 + x1) / 2 + h (a0 - a1) / 4
//     j / v = (4 m - 3 a0 - a1) / h in the first half, (3 a1 + a0 - 4 m) / h in the second
//
// What an axis demands is then linear in the four numbers at the ends of a cell, except for the jerk's factor v:
//
//     |q' a + q'' x| <= A        |q' j/v + 3 q'' a + q''' x| <= J / sqrt(x)
//
// The right side is a convex function of x. Its tangent lies below it, so what keeps to the tangent is allowed. The
// time is convex too. An interior point method solves the problem (primal and dual, with slacks). Each step solves a
// system of seven diagonals, so its time grows linearly with the cells; about ten steps are enough. A start beyond a
// limit is led back to the limit.
//
// The result must be checked: between the places that are looked at, demands may be a little larger.
#pragma once

#include <array>
#include <vector>

#include "jerk_cell.hpp"

namespace passo {

// The state of the motion at a node.
struct NodeState {
  double speed = 0;
  double acceleration = 0;
};

class JerkLift {
 public:
  explicit JerkLift(const std::vector<LimitedAxis>& axes) : axes_(axes) {}

  struct Stretch {
    const std::vector<JerkCell>& cells;
    const std::vector<AxisShape>& shapes;  // of each cell, one for each axis
    const std::vector<double>& share;      // share of the limits to use, for each cell
    const std::vector<double>& cap;        // the greatest squares of the speeds, for each cell
    const std::vector<double>& node_cap;   // and for each node
  };
  // Makes the motion between the nodes `first` and `last` fast. These two stay as they are. Each of them may be a rest;
  // all nodes between must have speed. At a rest the jerk is the same in all of the cell beside it. Returns false and
  // changes nothing if no way to keep the limits was found.
  [[nodiscard]] bool raise(const Stretch& stretch, std::size_t first, std::size_t last, std::vector<NodeState>& states);

 private:
  using Four = std::array<double, 4>;  // factors of x0, a0, x1, a1
  // One side of a limit: the room left to it, and its price (the multiplier).
  struct Side {
    double slack = 0;
    double by_slack = 0;
    double price = 0;
    double missing = 0;  // the slack, less what x and a leave
    double change = 0;   // of the slack in this step
  };
  struct Row {  // |along * (x, a) - offset| <= limit
    Four along{};
    double offset = 0;
    double limit = 0;
    Side up = {};
    Side down = {};
  };
  struct JoltRow {  // |along * (x, a)| <= limit / sqrt(square * (x, a))
    Four along{};
    Four square{};
    double limit = 0;
    double fall = 0;  // of the right side, with the square
    Side up = {};
    Side down = {};
  };
  struct Cell {
    Four middle{};      // the form of x in the middle
    Four to_and_fro{};  // the form of the middle's acceleration less the mean of the ends'
    double length = 0;
    bool has_rest = false;
    std::size_t rows_end = 0;
    std::size_t jolt_rows_end = 0;
  };
  // Beside a rest the acceleration at the cell's other node follows from the speed there: a = factor x. So a is no
  // unknown of its own.
  struct Tie {
    std::size_t node = 0;
    double factor = 0;  // 0: there is no rest
  };
  void tie(Four& along) const;
  void tie_step(const Tie& tied);

  void set_up(const Stretch& stretch, std::size_t first, std::size_t last, const std::vector<NodeState>& states);
  void make_rows(const Stretch& stretch, std::size_t first, std::size_t last);
  void make_rows_again(const Stretch& stretch, std::size_t first, std::size_t last);
  void add_rows(const Stretch& stretch, std::size_t cell, bool is_first);
  struct Place {
    double weight = 0;  // factor from x to the square of the axis's speed
    double share = 0;   // of the limits
    double x = 0;
    double cap = 0;  // the greatest x
  };
  void add_force_rows(const Row& row, const LimitedAxis& axis, const Four& x, const Place& place);
  void add_straight_rows(const JerkCell& cell, double share, double in_share);
  void add_cell_at_rest(const Stretch& stretch, std::size_t cell, bool begins);
  double highest_beside_rest(const Stretch& stretch, std::size_t cell, bool begins) const;
  void add_row(Row row);
  void add_jolt_row(JoltRow row);
  void measure(bool first_time);
  void assemble(double target);
  struct Block;
  void add_time(std::size_t c, Block& block) const;
  void add_to_system(std::size_t at, const Block& block);
  void solve();
  double look_along();
  void go(double share, double target);
  template <class Visit>
  void for_each_side(const Visit& visit);
  double time() const;
  bool is_allowed() const;

  std::vector<LimitedAxis> axes_;
  std::vector<double> at_;  // x and a of each node
  std::vector<Cell> cells_;
  std::vector<Row> rows_;
  std::vector<JoltRow> jolt_rows_;
  std::vector<Row> old_rows_;
  std::vector<JoltRow> old_jolt_rows_;
  Tie tied_first_;
  Tie tied_last_;
  std::size_t cell_ = 0;          // the cell whose rows are being made, counted from the first
  const double* here_ = nullptr;  // x and a at its ends
  std::vector<Four> system_;      // the diagonal, and the three beside it
  std::vector<double> step_;
};

}  // namespace passo
