#include "jerk_lift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace passo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr int most_steps = 40;
constexpr double first_target = 0.02;  // price times slack, as a share of the mean time of a cell
constexpr double last_target = 1e-4;
constexpr int steps_with_rows = 6;       // then they are made again
constexpr double target_falls = 0.2;     // the factor from step to step, at best
constexpr double short_of_limit = 0.95;  // a step goes at most this part of the way to a slack or price of 0
constexpr double least_share = 1e-3;     // of a step; if no more is possible, there is no solution
constexpr double passable = 0.05;        // a limit may be exceeded by this share; the check decides
constexpr double outer_part = 0.65;  // weight of x at the node in the mean speed of half a cell; the rest: the middle
constexpr double calming = 0.3;      // price of an acceleration that goes to and fro, in times of the cell
constexpr double least_slack = 0.3;  // slack at the start, as a share of the limit

double times(const std::array<double, 4>& factors, const double* values) {
  return factors[0] * values[0] + factors[1] * values[1] + factors[2] * values[2] + factors[3] * values[3];
}

std::array<double, 4> sum(const std::array<double, 4>& a, double factor_a, const std::array<double, 4>& b,
                          double factor_b) {
  return {a[0] * factor_a + b[0] * factor_b, a[1] * factor_a + b[1] * factor_b, a[2] * factor_a + b[2] * factor_b,
          a[3] * factor_a + b[3] * factor_b};
}

struct Forms {  // linear forms of a cell, in x0, a0, x1, a1
  explicit Forms(double h)
      : middle_x{0.5, h / 4, 0.5, -h / 4},
        middle_a{-1 / h, -0.5, 1 / h, -0.5},
        first{-2 / (h * h), -3 / h, 2 / (h * h), -1 / h},
        second{2 / (h * h), 1 / h, -2 / (h * h), 3 / h} {}
  std::array<double, 4> middle_x;
  std::array<double, 4> middle_a;
  std::array<double, 4> first;  // j / v
  std::array<double, 4> second;
};

constexpr std::array<double, 4> x_in = {1, 0, 0, 0};
constexpr std::array<double, 4> a_in = {0, 1, 0, 0};
constexpr std::array<double, 4> x_out = {0, 0, 1, 0};
constexpr std::array<double, 4> a_out = {0, 0, 0, 1};

}  // namespace

// From rest with jerk j the motion is at h = j t³/6 with v = j t²/2 and a = j t. So a = 2 x / 3 h.
void JerkLift::tie(Four& along) const {
  if (cell_ == tied_first_.node && tied_first_.factor != 0) {
    along[0] += tied_first_.factor * std::exchange(along[1], 0);
  }
  if (cell_ + 1 == tied_last_.node && tied_last_.factor != 0) {
    along[2] += tied_last_.factor * std::exchange(along[3], 0);
  }
}

void JerkLift::add_row(Row row) {
  tie(row.along);
  rows_.push_back(row);
}

void JerkLift::add_jolt_row(JoltRow row) {
  tie(row.along);
  tie(row.square);
  jolt_rows_.push_back(row);
}

// The greatest x at the node of the cell that is no rest. With the jerk the same in all of the cell, a³ = 6 h j², and
// each demand of an axis is a power of a.
double JerkLift::highest_beside_rest(const Stretch& stretch, std::size_t cell, bool begins) const {
  const JerkCell& own = stretch.cells[cell];
  const double h = own.length;
  const double by_jerk = 1 / std::sqrt(6 * h);
  const double by_speed = std::sqrt(1.5 * h);
  double most = infinity;    // of |a|
  double most_x = infinity;  // of x
  const auto meet = [&](double factor, double limit) {
    if (factor > 0 && limit < infinity) most = std::min(most, std::cbrt(limit * limit / (factor * factor)));
  };
  if (own.straight) {
    meet(by_jerk, own.jerk * stretch.share[cell]);
    most = std::min(most, own.acceleration * stretch.share[cell]);
  } else {
    const AxisShape* shape = &stretch.shapes[cell * axes_.size()];
    for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
      const double limit = axes_[k].jerk * stretch.share[cell];
      // Backwards in time the slope and the third derivative change their signs, and so does a.
      const double first = begins ? shape->slope_out : -shape->slope_in;
      const double second = begins ? shape->bend_out : shape->bend_in;
      const double third = begins ? shape->third_out : -shape->third_in;
      meet(std::abs(begins ? shape->slope_in : shape->slope_out) * by_jerk, limit);
      meet(std::abs(first * by_jerk + 3 * second * by_speed + third * by_speed * by_speed * by_speed), limit);
      const double force = std::abs(first * 2 / (3 * h) + second);
      if (force > 0) most_x = std::min(most_x, axes_[k].acceleration * stretch.share[cell] / force);
    }
  }
  return std::min(1.5 * h * most, most_x);
}

// In the first cell after a rest, or the last cell before one, only x at the other node is unknown.
void JerkLift::add_cell_at_rest(const Stretch& stretch, std::size_t cell, bool begins) {
  const std::size_t node = begins ? cell + 1 : cell;
  const double cap =
      std::min({stretch.cap[cell], stretch.node_cap[node], highest_beside_rest(stretch, cell, begins)}) / 2;
  rows_.push_back({.along = begins ? x_out : x_in, .offset = cap, .limit = cap});
}

void JerkLift::add_straight_rows(const JerkCell& cell, double share, double in_share) {
  const Forms forms(cell.length);
  if (cell.acceleration < infinity) {
    const double limit = cell.acceleration * share;
    if (in_share > 0) add_row({.along = a_in, .limit = cell.acceleration * in_share});
    add_row({.along = forms.middle_a, .limit = limit});
  }
  if (cell.jerk < infinity) {
    const double limit = cell.jerk * share;
    add_jolt_row(
        {.along = forms.first, .square = sum(x_in, outer_part, forms.middle_x, 1 - outer_part), .limit = limit});
    add_jolt_row(
        {.along = forms.second, .square = sum(x_out, outer_part, forms.middle_x, 1 - outer_part), .limit = limit});
  }
}

// Where the limit falls, the row uses the line that is the highest at the present speed: |force| + fall w <= at rest.
void JerkLift::add_force_rows(const Row& row, const LimitedAxis& axis, const Four& x, const Place& place) {
  add_row(row);
  if (!axis.falls_at(place.weight * place.cap)) return;
  const AccelerationCurve::Line& line = axis.line_at(place.weight * place.x);
  const double fall = place.share * place.weight * line.fall;
  add_row({.along = sum(row.along, 1, x, fall), .limit = place.share * line.at_rest});
  add_row({.along = sum(row.along, 1, x, -fall), .limit = place.share * line.at_rest});
}

void JerkLift::add_rows(const Stretch& stretch, std::size_t cell, bool is_first) {
  const JerkCell& own = stretch.cells[cell];
  const double share = stretch.share[cell];
  const double in_share = cell > 0 ? std::min(share, stretch.share[cell - 1]) : share;
  const Forms forms(own.length);
  const double half_cap = stretch.cap[cell] / 2;
  const double in_cap = std::min(half_cap, stretch.node_cap[cell] / 2);
  if (!is_first) add_row({.along = x_in, .offset = in_cap, .limit = in_cap});
  add_row({.along = forms.middle_x, .offset = half_cap, .limit = half_cap});
  if (own.straight) {
    add_straight_rows(own, share, is_first ? 0 : in_share);
    return;
  }
  // The jerk is the same in all of half a cell.
  const double* const at = here_;
  const double middle = std::max(times(forms.middle_x, at), std::min(at[0], at[2]) / 4);
  const double first = outer_part * at[0] + (1 - outer_part) * middle;
  const double second = outer_part * at[2] + (1 - outer_part) * middle;
  const AxisShape* shape = &stretch.shapes[cell * axes_.size()];
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const double third = (shape->third_in + shape->third_out) / 2;
    const double slope = (shape->slope_in + shape->slope_out) / 2 - own.length * own.length / 8 * third;
    const double bend = (shape->bend_in + shape->bend_out) / 2;
    if (slope == 0 && bend == 0 && third == 0) continue;
    if (axes_[k].acceleration < infinity) {
      const auto add_place = [&](const Four& a, const Four& x, double q1, double q2, double own_share) {
        add_force_rows({.along = sum(a, q1, x, q2), .limit = axes_[k].acceleration * own_share}, axes_[k], x,
                       {.weight = q1 * q1, .share = own_share, .x = times(x, at), .cap = stretch.cap[cell]});
      };
      if (!is_first) add_place(a_in, x_in, shape->slope_in, shape->bend_in, in_share);
      add_place(forms.middle_a, forms.middle_x, slope, bend, share);
    }
    if (axes_[k].jerk == infinity) continue;
    const double limit = axes_[k].jerk * share;
    const auto add_place = [&](const Four& j, const Four& a, const Four& x, double q1, double q2, double q3) {
      add_jolt_row({.along = sum(sum(j, q1, a, 3 * q2), 1, x, q3), .square = x, .limit = limit});
    };
    add_place(forms.first, a_in, x_in, shape->slope_in * std::sqrt(first / at[0]), shape->bend_in, shape->third_in);
    add_place(forms.first, forms.middle_a, forms.middle_x, slope * std::sqrt(first / middle), bend, third);
    add_place(forms.second, forms.middle_a, forms.middle_x, slope * std::sqrt(second / middle), bend, third);
    add_place(forms.second, a_out, x_out, shape->slope_out * std::sqrt(second / at[2]), shape->bend_out,
              shape->third_out);
  }
}

void JerkLift::set_up(const Stretch& stretch, std::size_t first, std::size_t last,
                      const std::vector<NodeState>& states) {
  tied_first_ = tied_last_ = {};
  if (states[first].speed == 0) tied_first_ = {.node = 1, .factor = 2 / (3 * stretch.cells[first].length)};
  if (states[last].speed == 0) {
    tied_last_ = {.node = last - first - 1, .factor = -2 / (3 * stretch.cells[last - 1].length)};
  }
  at_.clear();
  for (std::size_t k = first; k <= last; ++k) {
    at_.push_back(states[k].speed * states[k].speed);
    at_.push_back(states[k].acceleration);
  }
  for (const Tie& tied : {tied_first_, tied_last_}) {
    if (tied.factor != 0) at_[2 * tied.node + 1] = tied.factor * at_[2 * tied.node];
  }
  make_rows(stretch, first, last);
}

void JerkLift::make_rows(const Stretch& stretch, std::size_t first, std::size_t last) {
  cells_.clear();
  rows_.clear();
  jolt_rows_.clear();
  for (std::size_t k = first; k < last; ++k) {
    cell_ = k - first;
    here_ = &at_[2 * cell_];
    const bool begins = here_[0] == 0;
    const bool has_rest = begins || here_[2] == 0;
    if (has_rest) {
      add_cell_at_rest(stretch, k, begins);
    } else {
      add_rows(stretch, k, k == first);
    }
    const double h = stretch.cells[k].length;
    Four middle = Forms(h).middle_x;
    Four to_and_fro = {-1 / h, -1, 1 / h, -1};
    tie(middle);
    tie(to_and_fro);
    cells_.push_back({.middle = middle,
                      .to_and_fro = to_and_fro,
                      .length = h,
                      .has_rest = has_rest,
                      .rows_end = rows_.size(),
                      .jolt_rows_end = jolt_rows_.size()});
  }
}

// Where a cell bends, its rows have factors that hold for speeds near the present ones. Slacks and prices stay.
void JerkLift::make_rows_again(const Stretch& stretch, std::size_t first, std::size_t last) {
  old_rows_.swap(rows_);
  old_jolt_rows_.swap(jolt_rows_);
  make_rows(stretch, first, last);
  const auto take_over = [](const auto& from, auto& to) {
    for (std::size_t i = 0; i < to.size(); ++i) {
      to[i].up = from[i].up;
      to[i].down = from[i].down;
    }
  };
  take_over(old_rows_, rows_);
  take_over(old_jolt_rows_, jolt_rows_);
}

// Computes what is left of each limit.
void JerkLift::measure(bool first_time) {
  const auto put = [first_time](Side& side, double left, double limit) {
    if (first_time) side.slack = std::max(left, least_slack * limit);
    side.missing = side.slack - left;
    side.by_slack = 1 / side.slack;
  };
  std::size_t r = 0;
  std::size_t t = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double* const at = &at_[2 * c];
    for (; r < cells_[c].rows_end; ++r) {
      Row& row = rows_[r];
      const double value = times(row.along, at) - row.offset;
      put(row.up, row.limit - value, row.limit);
      put(row.down, row.limit + value, row.limit);
    }
    for (; t < cells_[c].jolt_rows_end; ++t) {
      JoltRow& row = jolt_rows_[t];
      const double value = times(row.along, at);
      const double by_square = 1 / times(row.square, at);
      const double limit = row.limit * std::sqrt(by_square);
      row.fall = 0.5 * limit * by_square;
      put(row.up, limit - value, limit);
      put(row.down, limit + value, limit);
    }
  }
}

// What one cell adds to the system.
struct JerkLift::Block {
  Four first{};  // products with x0, with a0, and so on
  Four second{};
  Four third{};
  Four fourth{};
  Four pull{};

  void add(const Four& g, double weight, double pulled) {
    const Four by = {weight * g[0], weight * g[1], weight * g[2], weight * g[3]};
    for (std::size_t k = 0; k < 4; ++k) {
      first[k] += by[0] * g[k];
      second[k] += by[1] * g[k];
      third[k] += by[2] * g[k];
      fourth[k] += by[3] * g[k];
      pull[k] += pulled * g[k];
    }
  }
};

void JerkLift::add_to_system(std::size_t at, const Block& block) {
  const std::array<const Four*, 4> rows = {&block.first, &block.second, &block.third, &block.fourth};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i; k < 4; ++k) system_[at + i][k - i] += (*rows[i])[k];
    step_[at + i] += block.pull[i];
  }
}

// Adds the time of a cell: the integral of 1/v by Simpson's rule; beside a rest, 3 h / v.
void JerkLift::add_time(std::size_t c, Block& block) const {
  const double* const at = &at_[2 * c];
  const Cell& cell = cells_[c];
  const auto put = [&](const Four& square, double weight) {
    const double x = times(square, at);
    const double by = weight / (x * std::sqrt(x));
    block.add(square, 0.75 * by / x, 0.5 * by);
  };
  if (cell.has_rest) return put(at[0] > 0 ? x_in : x_out, 3 * cell.length);
  put(x_in, cell.length / 6);
  put(cell.middle, cell.length * 2 / 3);
  put(x_out, cell.length / 6);
  // Without a price, an acceleration that goes to and fro within each cell costs nothing where the speed is steady.
  const double x = times(cell.middle, at);
  const double weight = calming * cell.length * cell.length * cell.length / (x * x * std::sqrt(x));
  block.add(cell.to_and_fro, weight, -weight * times(cell.to_and_fro, at));
}

double JerkLift::time() const {
  double sum = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double* const at = &at_[2 * c];
    if (cells_[c].has_rest) {
      sum += 3 * cells_[c].length / std::sqrt(std::max(at[0], at[2]));
      continue;
    }
    sum += cells_[c].length / 6 *
           (1 / std::sqrt(at[0]) + 4 / std::sqrt(times(cells_[c].middle, at)) + 1 / std::sqrt(at[2]));
  }
  return sum;
}

// Builds the system of one step. A side has slack s, price p and gradient g, and the product of slack and price is to
// become t. It adds p/s g g' to the left side and (t + p * missing) / s g to the right side.
void JerkLift::assemble(double target) {
  system_.assign(at_.size() + 4, Four{});
  step_.assign(at_.size() + 4, 0.0);
  std::size_t r = 0;
  std::size_t t = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    Block block;
    add_time(c, block);
    for (; r < cells_[c].rows_end; ++r) {
      const Row& row = rows_[r];
      const double up = row.up.by_slack;
      const double down = row.down.by_slack;
      block.add(row.along, row.up.price * up + row.down.price * down,
                (target + row.down.price * row.down.missing) * down - (target + row.up.price * row.up.missing) * up);
    }
    for (; t < cells_[c].jolt_rows_end; ++t) {
      const JoltRow& row = jolt_rows_[t];
      const auto put = [&](const Four& gradient, const Side& side) {
        block.add(gradient, side.price * side.by_slack, (target + side.price * side.missing) * side.by_slack);
      };
      put(sum(row.along, -1, row.square, -row.fall), row.up);
      put(sum(row.along, 1, row.square, -row.fall), row.down);
    }
    add_to_system(2 * c, block);
  }
}

// Solves for the numbers that move: all but the first two and the last two.
void JerkLift::solve() {
  const std::size_t end = at_.size() - 2;
  for (const Tie& tied : {tied_first_, tied_last_}) {
    if (tied.factor != 0) system_[2 * tied.node + 1][0] = 1;
  }
  for (std::size_t i = std::max<std::size_t>(end, 5) - 3; i < end; ++i) {
    for (std::size_t k = end - i; k < 4; ++k) system_[i][k] = 0;
  }
  for (std::size_t i = 2; i < end; ++i) {
    Four& own = system_[i];
    const double by = 1 / own[0];
    const Four factor = {0, own[1] * by, own[2] * by, own[3] * by};
    for (std::size_t k = 1; k < 4; ++k) {
      for (std::size_t l = k; l < 4; ++l) system_[i + k][l - k] -= factor[k] * own[l];
      step_[i + k] -= factor[k] * step_[i];
    }
    step_[i] *= by;
    own = factor;
  }
  for (std::size_t i = end; i < step_.size(); ++i) step_[i] = 0;
  step_[0] = step_[1] = 0;
  for (std::size_t i = end; i-- > 2;) {
    step_[i] -= system_[i][1] * step_[i + 1] + system_[i][2] * step_[i + 2] + system_[i][3] * step_[i + 3];
  }
  tie_step(tied_first_);
  tie_step(tied_last_);
}

void JerkLift::tie_step(const Tie& tied) {
  if (tied.factor != 0) step_[2 * tied.node + 1] = tied.factor * step_[2 * tied.node];
}

// The share of the step that may be made.
double JerkLift::look_along() {
  double back = 0;  // 1 / the distance at which the first slack becomes 0
  const auto put = [&back](Side& side, double change) {
    side.change = change - side.missing;
    back = std::max(back, -side.change * side.by_slack);
  };
  std::size_t r = 0;
  std::size_t t = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double* const at = &at_[2 * c];
    const double* const step = &step_[2 * c];
    if (!cells_[c].has_rest) {
      back = std::max(back, -1.2 * times(cells_[c].middle, step) / times(cells_[c].middle, at));
    }
    if (at[0] > 0) back = std::max(back, -1.2 * step[0] / at[0]);
    for (; r < cells_[c].rows_end; ++r) {
      const double change = times(rows_[r].along, step);
      put(rows_[r].up, -change);
      put(rows_[r].down, change);
    }
    for (; t < cells_[c].jolt_rows_end; ++t) {
      JoltRow& row = jolt_rows_[t];
      const double fall = row.fall * times(row.square, step);
      const double change = times(row.along, step);
      put(row.up, -change - fall);
      put(row.down, change - fall);
    }
  }
  return back > short_of_limit ? short_of_limit / back : 1;
}

template <class Visit>
void JerkLift::for_each_side(const Visit& visit) {
  for (Row& row : rows_) {
    visit(row.up);
    visit(row.down);
  }
  for (JoltRow& row : jolt_rows_) {
    visit(row.up);
    visit(row.down);
  }
}

void JerkLift::go(double share, double target) {
  double back = 0;
  for_each_side([&](Side& side) {
    // From here on `missing` is not needed; it holds the change of the price.
    side.missing = (target - side.price * side.change) * side.by_slack - side.price;
    if (-side.missing > back * side.price) back = -side.missing / side.price;
  });
  const double price_share = back > short_of_limit ? short_of_limit / back : 1;
  for_each_side([&](Side& side) {
    side.slack += share * side.change;
    side.price += price_share * side.missing;
  });
  for (std::size_t i = 2; i + 2 < at_.size(); ++i) at_[i] += share * step_[i];
}

bool JerkLift::is_allowed() const {
  const auto is_kept = [](const auto& row) {
    const double far = passable * (row.up.slack + row.down.slack);
    return row.up.missing - row.up.slack < far && row.down.missing - row.down.slack < far;
  };
  return std::all_of(rows_.begin(), rows_.end(), is_kept) && std::all_of(jolt_rows_.begin(), jolt_rows_.end(), is_kept);
}

bool JerkLift::raise(const Stretch& stretch, std::size_t first, std::size_t last, std::vector<NodeState>& states) {
  set_up(stretch, first, last, states);
  measure(true);
  const double unit = time() / static_cast<double>(cells_.size());
  double target = first_target * unit;
  for_each_side([target](Side& side) { side.price = target / side.slack; });
  for (int step = 0; step < most_steps; ++step) {
    assemble(target);
    solve();
    const double share = look_along();
    if (!(share > least_share)) break;
    go(share, target);
    if (step % steps_with_rows == steps_with_rows - 1) make_rows_again(stretch, first, last);
    measure(false);
    if (target <= last_target * unit && share > 0.5) break;
    double product = 0;
    std::size_t sides = 0;
    for_each_side([&](const Side& side) {
      product += side.slack * side.price;
      ++sides;
    });
    product /= static_cast<double>(sides);
    target = std::max(product * (1 - share * (1 - target_falls)), last_target * unit);
  }
  if (!is_allowed()) return false;
  for (std::size_t k = first + 1; k < last; ++k) {
    states[k] = {.speed = std::sqrt(at_[2 * (k - first)]), .acceleration = at_[2 * (k - first) + 1]};
  }
  return true;
}

}  // namespace passo
