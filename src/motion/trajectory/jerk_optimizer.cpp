#include "jerk_optimizer.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

// Usually 7 to 12 are enough. With many corners in a window a limit of one corner shortens the step of all of them, and
// 40 were too few: the window was not lifted, and the motion came to rest at its end.
constexpr int most_steps_of_lift = 80;
constexpr double first_target = 0.02;  // price times slack, as a share of the mean time of a cell
constexpr double last_target = 1e-4;
constexpr int steps_with_rows = 6;       // then they are made again
constexpr double target_falls = 0.2;     // the factor from step to step, at best
constexpr double short_of_limit = 0.95;  // a step goes at most this part of the way to a slack or price of 0
constexpr double least_share = 1e-3;     // of a step; if no more is possible, there is no solution
constexpr double passable = 0.05;        // a limit may be exceeded by this share; the check decides
constexpr double calming = 0.3;          // price of an acceleration that goes to and fro, in times of the cell
constexpr double most_taken = 0.45;      // share of a cell's mean x that an acceleration may take away at the start
constexpr double least_slack = 0.3;      // slack at the start, as a share of the limit

FourLanes lanes(const std::array<double, 4>& four) {
  return FourLanes::load(four.data());
}

double times(const std::array<double, 4>& factors, FourLanes values) {
  return (lanes(factors) * values).sum();
}

// The share of a step that may be made, where the whole step would go `back` times too far.
double short_of(double back) {
  return back > short_of_limit ? short_of_limit / back : 1;
}

}  // namespace

void JerkOptimizer::set_up(const Stretch& stretch, std::size_t first, std::size_t last,
                           const std::vector<NodeState>& states) {
  tied_first_ = tied_last_ = {};
  if (states[first].speed == 0) {
    tied_first_ = {.node = 1, .factor = 2 / (3 * stretch.cells[first].length), .holds = true};
  } else if (stretch.begins.square > 0) {
    tied_first_ = {.node = 0, .factor = stretch.begins.bend, .holds = true};
  }
  if (states[last].speed == 0) {
    tied_last_ = {.node = last - first - 1, .factor = -2 / (3 * stretch.cells[last - 1].length), .holds = true};
  } else if (stretch.ends.square > 0) {
    tied_last_ = {.node = last - first, .factor = stretch.ends.bend, .holds = true};
  }
  at_.clear();
  for (std::size_t k = first; k <= last; ++k) {
    at_.push_back(states[k].speed * states[k].speed);
    at_.push_back(states[k].acceleration);
  }
  for (const Tie& tied : {tied_first_, tied_last_}) {
    if (tied.holds) at_[2 * tied.node + 1] = tied.factor * at_[2 * tied.node];
  }
  make_passable(stretch, first);
  make_rows(stretch, first, last);
  rows_.resize(rows_made_);
  jolt_rows_.resize(jolt_rows_made_);
}

// A guess may have accelerations that leave no speed in the middle of a long cell beside a short one. Then all of them
// are lowered to what leaves some speed: each takes less than half of the mean x of a cell away.
void JerkOptimizer::make_passable(const Stretch& stretch, std::size_t first) {
  const std::size_t nodes = at_.size() / 2;
  const auto most = [&](std::size_t cell) {
    return most_taken * 2 * (at_[2 * cell] + at_[2 * cell + 2]) / stretch.cells[first + cell].length;
  };
  const auto is_passable = [&](std::size_t cell) {
    const double* const at = &at_[2 * cell];
    return at[0] == 0 || at[2] == 0 ||
           (at[0] + at[2]) / 2 + stretch.cells[first + cell].length * (at[1] - at[3]) / 4 > 0;
  };
  std::size_t cell = 0;
  while (cell + 1 < nodes && is_passable(cell)) ++cell;
  if (cell + 1 == nodes) return;
  for (std::size_t node = 1; node + 1 < nodes; ++node) {
    if (!is_tied(node)) at_[2 * node + 1] = std::clamp(at_[2 * node + 1], -most(node), most(node - 1));
  }
}

// Computes what x and a leave of each limit, and shows it to `visit`.
template <class Visit>
void JerkOptimizer::measure(const Visit& visit) {
  std::size_t r = 0;
  std::size_t t = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    Cell& cell = cells_[c];
    const auto at = FourLanes::load(&at_[2 * c]);
    for (std::size_t p = 0; p < cell.pace_count; ++p) {
      Pace& pace = cell.paces[p];
      pace.by_square = 1 / times(pace.square, at);
      pace.by_speed = std::sqrt(pace.by_square);
    }
    for (; r < cell.rows_end; ++r) {
      Row& row = rows_[r];
      const double value = times(row.along, at) - row.offset;
      visit(row.sides, TwoLanes(row.limit - value, row.limit + value), row.limit);
    }
    for (; t < cell.jolt_rows_end; ++t) {
      JoltRow& row = jolt_rows_[t];
      const double value = times(row.along, at);
      const double limit = row.limit * cell.pace(row.place).by_speed;
      visit(row.sides, TwoLanes(limit - value, limit + value), limit);
    }
  }
}

// What one cell adds to the system: its symmetric matrix, from the diagonal on.
struct JerkOptimizer::Block {
  FourLanes first;  // products with x0, with a0, and so on
  FourLanes second;
  TwoLanes third;  // with x1 and a1 only
  TwoLanes fourth;
  FourLanes pull;

  void add(FourLanes g, double weight, double pulled) {
    const FourLanes by = g * weight;
    first += g * by.low().first();
    second += g * by.low().second();
    third += g.high() * by.high().first();
    fourth += g.high() * by.high().second();
    pull += g * pulled;
  }
};

void JerkOptimizer::add_to_system(std::size_t at, const Block& block) {
  std::array<Four, 4> rows{};
  block.first.store(rows[0].data());
  block.second.store(rows[1].data());
  block.third.store(&rows[2][2]);
  block.fourth.store(&rows[3][2]);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i; k < 4; ++k) system_[at + i][k - i] += rows[i][k];
  }
  (FourLanes::load(&step_[at]) + block.pull).store(&step_[at]);
}

// Adds the time of a cell: the integral of 1/v by Simpson's rule; beside a rest, 3 h / v.
void JerkOptimizer::add_time(std::size_t c, Block& block) {
  const double* const at = &at_[2 * c];
  const Cell& cell = cells_[c];
  const auto put_node = [&](std::size_t place, double weight, double by_square, double by_speed) {
    const double by = weight * by_square * by_speed;
    system_[2 * c + place][0] += 0.75 * by * by_square;
    step_[2 * c + place] += 0.5 * by;
  };
  if (cell.has_rest()) {
    const double by_square = 1 / std::max(at[0], at[2]);
    return put_node(at[0] > 0 ? 0 : 2, 3 * cell.length, by_square, std::sqrt(by_square));
  }
  const Pace& in = cell.pace(At::in);
  const Pace& middle = cell.pace(At::middle);
  const Pace& out = cell.pace(At::out);
  put_node(0, cell.length / 6, in.by_square, in.by_speed);
  put_node(2, cell.length / 6, out.by_square, out.by_speed);
  const double by = cell.length * 2 / 3 * middle.by_square * middle.by_speed;
  block.add(lanes(middle.square), 0.75 * by * middle.by_square, 0.5 * by);
  // Without a price, an acceleration that goes to and fro within each cell costs nothing where the speed is steady.
  const double weight =
      calming * cell.length * cell.length * cell.length * middle.by_square * middle.by_square * middle.by_speed;
  block.add(lanes(cell.to_and_fro), weight, -weight * times(cell.to_and_fro, FourLanes::load(at)));
}

double JerkOptimizer::time() const {
  double sum = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Cell& cell = cells_[c];
    if (cell.has_rest()) {
      sum += 3 * cell.length / std::sqrt(std::max(at_[2 * c], at_[2 * c + 2]));
      continue;
    }
    sum += cell.length / 6 *
           (cell.pace(At::in).by_speed + 4 * cell.pace(At::middle).by_speed + cell.pace(At::out).by_speed);
  }
  return sum;
}

// Builds the system of one step. A side has slack s, price p and gradient g, and the product of slack and price is to
// become t. It adds p/s g g' to the left side and (t + p * missing) / s g to the right side.
void JerkOptimizer::assemble(double target) {
  system_.assign(at_.size() + 4, Four{});
  step_.assign(at_.size() + 4, 0.0);
  const TwoLanes wanted(target);
  std::size_t r = 0;
  std::size_t t = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Cell& cell = cells_[c];
    Block block;
    add_time(c, block);
    for (; r < cell.rows_end; ++r) {
      const Sides& sides = rows_[r].sides;
      const TwoLanes pull = (wanted + sides.price * sides.missing) * sides.by_slack;
      block.add(lanes(rows_[r].along), (sides.price * sides.by_slack).sum(), pull.second() - pull.first());
    }
    for (; t < cell.jolt_rows_end; ++t) {
      const JoltRow& row = jolt_rows_[t];
      const Sides& sides = row.sides;
      const Pace& pace = cell.pace(row.place);
      const TwoLanes weight = sides.price * sides.by_slack;
      const TwoLanes pull = (wanted + sides.price * sides.missing) * sides.by_slack;
      const FourLanes along = lanes(row.along);
      const FourLanes fall = lanes(pace.square) * (row.limit * pace.fall());
      block.add(along + fall, weight.first(), -pull.first());
      block.add(along - fall, weight.second(), pull.second());
    }
    add_to_system(2 * c, block);
  }
}

void JerkOptimizer::solve() {
  const std::size_t begin = first_moved();
  const std::size_t end = last_moved();
  for (const Tie& tied : {tied_first_, tied_last_}) {
    if (tied.holds) system_[2 * tied.node + 1][0] = 1;
  }
  for (std::size_t i = std::max<std::size_t>(end, 5) - 3; i < end; ++i) {
    for (std::size_t k = end - i; k < 4; ++k) system_[i][k] = 0;
  }
  for (std::size_t i = begin; i < end; ++i) {
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
  for (std::size_t i = 0; i < begin; ++i) step_[i] = 0;
  for (std::size_t i = end; i-- > begin;) {
    step_[i] -= system_[i][1] * step_[i + 1] + system_[i][2] * step_[i + 2] + system_[i][3] * step_[i + 3];
  }
  tie_step(tied_first_);
  tie_step(tied_last_);
}

void JerkOptimizer::tie_step(const Tie& tied) {
  if (tied.holds) step_[2 * tied.node + 1] = tied.factor * step_[2 * tied.node];
}

// Finds how slacks and prices change with the step, and the shares of these changes that may be made.
JerkOptimizer::Reach JerkOptimizer::reach_along(double target) {
  double back = 0;  // 1 / the distance at which the first x becomes 0
  TwoLanes slack_back;
  TwoLanes price_back;
  const TwoLanes wanted(target);
  const TwoLanes none;
  const auto put = [&](Sides& sides, TwoLanes change) {
    sides.change = change - sides.missing;
    sides.price_change = (wanted - sides.price * sides.change) * sides.by_slack - sides.price;
    slack_back = larger(slack_back, none - sides.change * sides.by_slack);
    price_back = larger(price_back, none - sides.price_change / sides.price);
  };
  std::size_t r = 0;
  std::size_t t = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Cell& cell = cells_[c];
    const auto step = FourLanes::load(&step_[2 * c]);
    std::array<double, 5> rise{};  // of x at each place
    for (std::size_t p = 0; p < cell.pace_count; ++p) {
      rise[p] = times(cell.paces[p].square, step);
      back = std::max(back, -1.2 * rise[p] * cell.paces[p].by_square);
    }
    for (; r < cell.rows_end; ++r) {
      const double change = times(rows_[r].along, step);
      put(rows_[r].sides, {-change, change});
    }
    for (; t < cell.jolt_rows_end; ++t) {
      JoltRow& row = jolt_rows_[t];
      const double fall = row.limit * cell.pace(row.place).fall() * rise[static_cast<std::size_t>(row.place)];
      const double change = times(row.along, step);
      put(row.sides, {-change - fall, change - fall});
    }
  }
  return {.share = short_of(std::max(back, slack_back.largest())), .price_share = short_of(price_back.largest())};
}

// Begins with slacks and prices whose products are even. Returns the mean time of a cell.
double JerkOptimizer::begin_prices() {
  measure([](Sides& sides, TwoLanes left, double limit) {
    sides.slack = larger(left, TwoLanes(least_slack * limit));
    sides.missing = sides.slack - left;
    sides.by_slack = TwoLanes(1.0) / sides.slack;
  });
  const double unit = time() / static_cast<double>(cells_.size());
  for (Row& row : rows_) row.sides.price = row.sides.by_slack * (first_target * unit);
  for (JoltRow& row : jolt_rows_) row.sides.price = row.sides.by_slack * (first_target * unit);
  return unit;
}

// Changes slacks and prices by their shares of the step, after x and a have changed. Returns the mean product of a
// slack and its price.
double JerkOptimizer::go(const Reach& reach) {
  TwoLanes product;
  measure([&](Sides& sides, TwoLanes left, double) {
    sides.slack += sides.change * reach.share;
    sides.price += sides.price_change * reach.price_share;
    sides.missing = sides.slack - left;
    sides.by_slack = TwoLanes(1.0) / sides.slack;
    product += sides.slack * sides.price;
  });
  return product.sum() / static_cast<double>(2 * (rows_.size() + jolt_rows_.size()));
}

bool JerkOptimizer::is_allowed() const {
  const auto is_kept = [](const auto& row) {
    return (row.sides.missing - row.sides.slack).largest() < passable * row.sides.slack.sum();
  };
  return std::all_of(rows_.begin(), rows_.end(), is_kept) && std::all_of(jolt_rows_.begin(), jolt_rows_.end(), is_kept);
}

bool JerkOptimizer::raise(const Stretch& stretch, std::size_t first, std::size_t last, std::vector<NodeState>& states) {
  set_up(stretch, first, last, states);
  const double unit = begin_prices();
  if (!(unit > 0)) return false;
  double target = first_target * unit;
  for (int step = 0; step < most_steps_of_lift; ++step) {
    assemble(target);
    solve();
    const Reach reach = reach_along(target);
    if (!(reach.share > least_share)) break;
    for (std::size_t i = first_moved(); i < last_moved(); ++i) at_[i] += reach.share * step_[i];
    if (step % steps_with_rows == steps_with_rows - 1) make_rows(stretch, first, last);
    const double product = go(reach);
    if (target <= last_target * unit && reach.share > 0.5) break;
    target = std::max(product * (1 - reach.share * (1 - target_falls)), last_target * unit);
  }
  if (!is_allowed()) return false;
  for (std::size_t k = begins_free() ? first : first + 1; k < (ends_free() ? last + 1 : last); ++k) {
    states[k] = {.speed = std::sqrt(at_[2 * (k - first)]), .acceleration = at_[2 * (k - first) + 1]};
  }
  return true;
}

}  // namespace passo
