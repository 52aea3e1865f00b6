// JerkLift: makes of a motion over cells nearly the fastest. Private to trajectory/.
//
// At each node it has the square x of the speed and the acceleration a. Over each half of a cell a goes straight over
// the way, so that with m = (x1 - x0) / 2h
//
//     a in the middle = 2 m - (a0 + a1) / 2      x in the middle = (x0 + x1) / 2 + h (a0 - a1) / 4
//     j / v = (4 m - 3 a0 - a1) / h in the first half, (3 a1 + a0 - 4 m) / h in the second
//
// and what an axis demands is linear in the four numbers at the ends of a cell, but for the jerk's factor v:
//
//     |q' a + q'' x| <= A        |q' j/v + 3 q'' a + q''' x| <= J / sqrt(x)
//
// The right side bends upwards: its tangent lies below it, so what keeps to the tangents is allowed, and the time is
// convex. Solved by an interior point method (primal and dual, with slacks): a step solves a system of seven diagonals,
// so its time grows with the cells, and about ten steps do. A start that is beyond a limit is led back to it.
//
// What it finds is to be checked: between the places looked at the demands may be a little larger.
#pragma once

#include <array>
#include <vector>

#include "jerk_cell.hpp"

namespace passo {

// How the motion passes a node.
struct NodeState {
  double speed = 0;
  double acceleration = 0;
};

class JerkLift {
 public:
  explicit JerkLift(const std::vector<LimitedAxis>& axes) : axes_(axes) {}

  struct Stretch {
    const std::vector<JerkCell>& cells;
    const std::vector<AxisShape>& shapes;  // of each cell, one an axis
    const std::vector<double>& share;      // of the limits, in each cell
    const std::vector<double>& cap;        // of the squares of the speeds there
  };
  // Of the nodes from `first` to `last` all but these two are raised; each must have speed. False where no way to keep
  // the limits was found: then all stays.
  [[nodiscard]] bool raise(const Stretch& stretch, std::size_t first, std::size_t last, std::vector<NodeState>& states);

 private:
  using Four = std::array<double, 4>;  // factors of x0, a0, x1, a1
  // One of the sides of a limit: what is left to it, and its price (the multiplier).
  struct Side {
    double slack = 0;
    double by_slack = 0;
    double price = 0;
    double missing = 0;  // of the slack, to what x and a leave
    double change = 0;   // of the slack, by the step
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
    double fall = 0;  // of the right side, by the square
    Side up = {};
    Side down = {};
  };
  struct Cell {
    Four middle{};  // x there
    double length = 0;
    std::size_t rows_end = 0;
    std::size_t jolt_rows_end = 0;
  };

  void set_up(const Stretch& stretch, std::size_t first, std::size_t last, const std::vector<NodeState>& states);
  void add_rows(const Stretch& stretch, std::size_t cell, bool is_first);
  struct Place {
    double weight = 0;  // of x in the square of the axis's speed
    double share = 0;   // of the limits
    double x = 0;
    double cap = 0;  // of x
  };
  void add_force_rows(const Row& row, const LimitedAxis& axis, const Four& x, const Place& place);
  void add_straight_rows(const JerkCell& cell, double share, bool is_first);
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
  std::vector<Four> system_;  // its diagonal, and three beside it
  std::vector<double> step_;
};

}  // namespace passo
