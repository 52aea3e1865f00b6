#include "jerk_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Parts of the limits that are planned with; the rest is for what straight pieces do not see.
constexpr double planned_jerk = 0.95;
constexpr double planned_acceleration = 0.98;
constexpr double planned_velocity = 0.9999;
constexpr double constant_speed_jerk = 0.9;  // of the jerk, for the bends of the path alone
constexpr double most_growth = 3;            // of x within a cell where more cannot be played
constexpr double most_above_cap = 4;
constexpr int most_repairs = 80;
constexpr int rounds_a_refinement = 10;
constexpr double least_share = 0.2;
constexpr std::size_t most_undecided = 600;  // cells in which a calm place is looked for
constexpr double looked_at = 0.99;           // curves are looked at in three places of a cell
// Of the acceleration: a change that is none.
constexpr double unseen_change = 1e-6;
constexpr double weak = 100;    // mm/s², for axes without a limit
constexpr double accepted = 1;  // of a limit

}  // namespace

void JerkProfile::push(const JerkCell& cell, const AxisShape* shapes, bool at_rest) {
  double cap = at_rest ? 0 : cell.top_squared;
  const bool joined = !cells_.empty();
  const AxisShape* before = joined ? this->shapes(cells_.size() - 1) : nullptr;
  if (joined) cap = std::min(cap, cells_.back().top_squared);
  if (cap > 0) cap *= planned_velocity * planned_velocity;
  if (cap > 0 && !(cell.straight && joined && cells_.back().straight)) {
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      double bend = std::abs(shapes[k].bend_in);
      double third = std::abs(shapes[k].third_in);
      if (joined) {
        const double jump = std::abs(shapes[k].bend_in - before[k].bend_out);
        if (jump * cap > unseen_jump * axes_[k].acceleration) cap = unseen_jump * axes_[k].acceleration / jump;
        bend = std::max(bend, std::abs(before[k].bend_out));
        third = std::max(third, std::abs(before[k].third_out));
      }
      if (bend * cap > planned_acceleration * axes_[k].acceleration) {
        cap = planned_acceleration * axes_[k].acceleration / bend;
      }
      if (third > 0 && third * cap * std::sqrt(cap) > constant_speed_jerk * axes_[k].jerk) {
        cap = std::pow(constant_speed_jerk * axes_[k].jerk / third, 2.0 / 3);
      }
    }
  }
  cells_.push_back(cell);
  shapes_.insert(shapes_.end(), shapes, shapes + axes_.size());
  entry_cap_.push_back(cap);
  entry_share_.push_back(planned_jerk);
}

double JerkProfile::duration(std::size_t i) const {
  const double sum = std::sqrt(x_[i]) + std::sqrt(x_[i + 1]);
  return sum > 0 ? 2 * cells_[i].length / sum : 0;
}

// What the axes leave for the jerk along the path: |q' j + 3 q'' v a + q''' v³| <= J.
void JerkProfile::widen(Range& range, std::size_t cell, bool at_end, double v, double a) const {
  const JerkCell& own = cells_[cell];
  const double share = share_[at_end ? cell + 1 : cell];
  if (own.straight) {
    range.high = std::min(range.high, own.jerk * share);
    range.low = std::max(range.low, -own.jerk * share);
    return;
  }
  const AxisShape* shape = shapes(cell);
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const double first = at_end ? shape->slope_out : shape->slope_in;
    const double second = at_end ? shape->bend_out : shape->bend_in;
    const double third = at_end ? shape->third_out : shape->third_in;
    const double limit = axes_[k].jerk * share;
    if (first == 0 || limit == infinity) continue;
    const double taken = (3 * second * a + third * v * v) * v;
    const double sign = first > 0 ? 1 : -1;
    range.high = std::min(range.high, (limit - sign * taken) / std::abs(first));
    range.low = std::max(range.low, (-limit - sign * taken) / std::abs(first));
  }
}

JerkProfile::Range JerkProfile::jerk_range(std::size_t node, double v, double a) const {
  Range range{-1e13, 1e13};
  if (node > 0) widen(range, node - 1, true, v, a);
  if (node < cells_.size()) widen(range, node, false, v, a);
  return range;
}

// The largest slope (forwards) or, negative, the steepest fall (backwards) of a cell for which every axis has the
// acceleration; `near` is x where the step begins.
double JerkProfile::most_acceleration(std::size_t i, bool backwards, double near) const {
  const JerkCell& cell = cells_[i];
  if (cell.straight) return cell.acceleration * planned_acceleration;
  double most = infinity;
  const double h2 = 2 * cell.length;
  const AxisShape* shape = shapes(i);
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const double limit = axes_[k].acceleration * planned_acceleration;
    if (limit == infinity) continue;
    const double near_slope = backwards ? -shape->slope_out : shape->slope_in;
    const double near_bend = backwards ? shape->bend_out : shape->bend_in;
    const double far_slope = backwards ? -shape->slope_in : shape->slope_out;
    const double far_bend = backwards ? shape->bend_in : shape->bend_out;
    const auto meet = [&](double factor, double taken) {
      if (factor > 0) most = std::min(most, (limit - taken) / factor);
      if (factor < 0) most = std::min(most, (-limit - taken) / factor);
    };
    meet(near_slope, near_bend * near);
    meet(far_slope + h2 * far_bend, far_bend * near);
  }
  return most;
}

// Across cell i, the acceleration rising as it may. Whether the profile is as high as its cap there, and no slope of
// it counts behind.
bool JerkProfile::step(std::size_t i, bool backwards, March& march) const {
  const std::size_t near = backwards ? i + 1 : i;
  const std::size_t far = backwards ? i : i + 1;
  const double h = cells_[i].length;
  const double most = most_acceleration(i, backwards, march.x);
  double slope = 0;
  double time = 0;
  if (march.x == 0) {
    Range range{-1e13, 1e13};
    widen(range, i, backwards, 0, 0);
    time = std::cbrt(6 * h / range.high);
    slope = std::min(0.75 * range.high * time, 0.75 * most);
  } else {
    const double v = std::sqrt(march.x);
    const double a = backwards ? -march.slope : march.slope;
    const double high = jerk_range(near, v, a).high;
    const auto rise = [&](double guess) {
      time = 2 * h / (v + std::sqrt(std::max(march.x + 2 * h * guess, 0.0)));
      return march.slope + high * (march.half + time / 2);
    };
    slope = rise(std::max(march.slope, 0.0));
    slope = rise(std::clamp(slope, 0.0, most));
    slope = std::min(slope, most);
  }
  slope = std::max(slope, 0.0);
  double x = march.x + 2 * h * slope;
  bool free = false;
  if (x >= cap_[far]) {
    x = cap_[far];
    slope = (x - march.x) / (2 * h);
    free = slope <= 0;
  }
  time = 2 * h / (std::sqrt(march.x) + std::sqrt(x));
  if (free || x == 0) {
    march = {.x = x, .slope = 0, .half = 0};
  } else {
    march = {.x = x, .slope = slope, .half = (march.x == 0 ? slope / 3 / (slope / time * 4 / 3) * 2 : time / 2)};
    if (march.half != march.half) march.half = 0;
  }
  return free || x == 0;
}

void JerkProfile::go_forwards() {
  March march{.x = cap_[0]};
  std::size_t i = 0;
  forwards_[0] = cap_[0];
  if (frozen_ > 0) {
    i = 1;
    forwards_[1] = x_[1];
    march = {.x = x_[1], .slope = slope(0), .half = duration(0) / 2};
  }
  for (; i < cells_.size(); ++i) {
    step(i, false, march);
    forwards_[i + 1] = march.x;
  }
}

// Lowers x_ to what braking allows; the last node from which on nothing to come matters.
std::size_t JerkProfile::go_backwards(bool closed) {
  std::size_t decided = closed ? cells_.size() : 0;
  March march{.x = cap_[cells_.size()]};
  x_[cells_.size()] = std::min(march.x, forwards_[cells_.size()]);
  const std::size_t first = frozen_ > 0 ? 1 : 0;
  for (std::size_t i = cells_.size(); i-- > first;) {
    const bool free = step(i, true, march);
    if (free && decided == 0) decided = i;
    if (i == first && frozen_ > 0) {
      if (march.x < x_[i] * (1 - 1e-9)) return cannot_brake;
      continue;
    }
    x_[i] = std::min(march.x, forwards_[i]);
  }
  return decided;
}

// By how much the slope may drop at a node.
double JerkProfile::drop_at(std::size_t node) const {
  const double v = std::sqrt(x_[node]);
  const double time = (duration(node - 1) + duration(node)) / 2;
  const double before = slope(node - 1);
  const double after = slope(node);
  const double low = std::max(jerk_range(node, v, before).low, jerk_range(node, v, after).low);
  return std::max(-low, 0.0) * time;
}

void JerkProfile::cut_corners() {
  const std::size_t n = cells_.size();
  const std::size_t first = frozen_ > 0 ? 1 : 0;
  for (std::size_t i = first + 1; i < n; ++i) drops_[i] = x_[i] > 0 ? drop_at(i) : 0;
  std::vector<double>& y = forwards_;  // not needed any more
  std::size_t begin = first;
  hull_.clear();
  while (begin < n) {
    std::size_t end = begin + 1;
    while (end < n && x_[end] > 0) ++end;
    // Between rests: y = x + G, G's slope growing by the drops.
    y[begin] = x_[begin];
    double steep = 0;
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) {
      if (i > begin) steep += 2 * drops_[i];
      sum += steep * cells_[i].length;
      y[i + 1] = x_[i + 1] + sum;
    }
    const std::size_t base = hull_.size();
    const auto place = [&](std::size_t i) { return place_[i]; };
    for (std::size_t i = begin; i <= end; ++i) {
      while (hull_.size() >= base + 2) {
        const std::size_t k = hull_.back();
        const std::size_t j = hull_[hull_.size() - 2];
        if ((y[i] - y[k]) * (place(k) - place(j)) > (y[k] - y[j]) * (place(i) - place(k))) break;
        hull_.pop_back();
      }
      hull_.push_back(i);
    }
    for (std::size_t k = base; k + 1 < hull_.size(); ++k) {
      const std::size_t from = hull_[k];
      const std::size_t to = hull_[k + 1];
      if (to == from + 1) continue;
      const double steepness = (y[to] - y[from]) / (place(to) - place(from));
      for (std::size_t i = from + 1; i < to; ++i) {
        const double lowered = y[from] + steepness * (place(i) - place(from)) - (y[i] - x_[i]);
        x_[i] = std::min(x_[i], std::max(lowered, 0.0));
      }
    }
    begin = end;
    if (begin < n) hull_.pop_back();  // the rest begins the next
  }
}

void JerkProfile::prepare() {
  const std::size_t n = cells_.size();
  cap_.assign(entry_cap_.begin(), entry_cap_.end());
  cap_.push_back(0);
  share_.assign(entry_share_.begin(), entry_share_.end());
  share_.push_back(planned_jerk);
  if (frozen_ == 0) cap_[0] = 0;
  forwards_.resize(n + 1);
  x_.resize(n + 1, 0.0);
  drops_.resize(n + 1);
  place_.resize(n + 1);
  place_[0] = 0;
  for (std::size_t i = 0; i < n; ++i) place_[i + 1] = place_[i] + cells_[i].length;
}

// In two halves.
void JerkProfile::split(std::size_t i) {
  const auto at = [](auto& list, std::size_t k) { return list.begin() + static_cast<std::ptrdiff_t>(k); };
  JerkCell second = cells_[i];
  const double half = second.length / 2;
  second.start += half;
  second.length -= half;
  cells_[i].length = half;
  cells_[i].ends_segment = false;
  const std::vector<AxisShape> whole(shapes(i), shapes(i) + axes_.size());
  cells_.insert(at(cells_, i + 1), second);
  shapes_.insert(at(shapes_, (i + 1) * axes_.size()), whole.begin(), whole.end());
  double cap = second.top_squared * planned_velocity * planned_velocity;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    AxisShape& first = shapes(i)[k];
    AxisShape& last = shapes(i + 1)[k];
    first.third_out = last.third_in = (whole[k].third_in + whole[k].third_out) / 2;
    first.bend_out = last.bend_in = (whole[k].bend_in + whole[k].bend_out) / 2;
    first.slope_out = last.slope_in = (whole[k].slope_in + whole[k].slope_out) / 2 - half * half / 2 * first.third_out;
    if (std::abs(last.bend_in) * cap > planned_acceleration * axes_[k].acceleration) {
      cap = planned_acceleration * axes_[k].acceleration / std::abs(last.bend_in);
    }
    const double third = std::abs(last.third_in);
    if (third > 0) cap = std::min(cap, std::pow(constant_speed_jerk * axes_[k].jerk / third, 2.0 / 3));
  }
  entry_cap_.insert(at(entry_cap_, i + 1), cap);
  entry_share_.insert(at(entry_share_, i + 1), planned_jerk);
}

// From rest there is no plan to fall back on: finer cells make one.
void JerkProfile::refine() {
  for (std::size_t k = exceeded_.size(); k-- > 0;) {
    const std::size_t i = exceeded_[k];
    const bool apart = k + 1 == exceeded_.size() || exceeded_[k + 1] > i + 1;
    if (apart && i + 1 < cells_.size()) split(i + 1);
    split(i);
    if (i > 0 && (k == 0 || exceeded_[k - 1] + 2 < i)) split(i - 1);
  }
  prepare();
}

std::size_t JerkProfile::plan(bool closed) {
  prepare();
  kept_.assign(x_.begin(), x_.end());
  std::size_t decided = 0;
  bool good = false;
  bool new_cells = true;  // cut since `decided` was counted
  for (int round = 0; round < most_repairs && !good; ++round) {
    if (frozen_ > 0) {
      cap_[0] = std::max(cap_[0], kept_[0]);
      cap_[1] = std::max(cap_[1], kept_[1]);
    }
    go_forwards();
    const std::size_t free = go_backwards(closed);
    if (free == cannot_brake) break;
    if (new_cells) decided = free;
    new_cells = false;
    cut_corners();
    good = !lower_where_exceeded(round);
    if (!good && frozen_ == 0 && round % rounds_a_refinement == rounds_a_refinement - 1) {
      refine();
      new_cells = true;
    }
  }
  fell_back_ = !good && frozen_ > 0;
  if (fell_back_) return go_on_as_planned();
  const std::size_t n = cells_.size();
  planned_ = n;
  if (closed) return n;
  // The last chord whose both ends are decided, and preferably where nothing was repaired: what is given there will
  // not be regretted.
  std::size_t last = 0;
  std::size_t calm = 0;
  for (std::size_t k = 0; k + 1 < hull_.size() && hull_[k + 1] <= decided; ++k) {
    last = hull_[k];
    if (is_calm(last)) calm = last;
  }
  if (calm >= 2) {
    last = calm;
  } else if (n < most_undecided) {
    return 0;
  }
  for (std::size_t i = 0; i < last; ++i) {
    entry_cap_[i] = cap_[i];
    entry_share_[i] = share_[i];
  }
  return last >= 2 ? last - 1 : 0;
}

bool JerkProfile::is_calm(std::size_t node) const {
  const std::size_t from = node > 3 ? node - 3 : 0;
  const std::size_t to = std::min(node + 8, cells_.size());
  for (std::size_t i = from; i < to; ++i) {
    if (share_[i] != entry_share_[i] || cap_[i] < entry_cap_[i]) return false;
  }
  return true;
}

// There is a plan from before, to rest at the end of what was known then: a part of it is played.
std::size_t JerkProfile::go_on_as_planned() {
  x_.assign(kept_.begin(), kept_.end());
  std::fill(x_.begin() + static_cast<std::ptrdiff_t>(planned_), x_.end(), 0.0);
  return std::max<std::size_t>(planned_ / 4, 1);
}

JerkProfile::State JerkProfile::state(std::size_t node) const {
  const std::size_t n = cells_.size();
  if (node == 0 && frozen_ > 0) return start_;
  if (node == 0 || node == n || x_[node] <= 0) return {};
  const double left = cells_[node - 1].length;
  const double right = cells_[node].length;
  const double before = slope(node - 1);
  const double after = slope(node);
  if (x_[node - 1] <= 0) return {.speed = std::sqrt(x_[node]), .acceleration = before * 4 / 3};
  if (x_[node + 1] <= 0) return {.speed = std::sqrt(x_[node]), .acceleration = after * 4 / 3};
  const double share = left / (left + right);
  return {.speed = std::sqrt(std::max(x_[node] + (after - before) * share * right / 2, 0.0)),
          .acceleration = before + (after - before) * share};
}

// From one state to the other over the cell's length: h = (v0 + v1) t - (a1 - a0) t²/3 with t half the time.
JerkProfile::Pair JerkProfile::pair_of(std::size_t i) const {
  const State from = state(i);
  const State to = state(i + 1);
  const double h = cells_[i].length;
  const double sum = from.speed + to.speed;
  const double change = to.acceleration - from.acceleration;
  const double root = sum * sum - 4.0 / 3 * change * h;
  Pair pair;
  if (!(root > 0)) return pair;
  const double t = 2 * h / (sum + std::sqrt(root));
  pair.half = t;
  pair.first = ((to.speed - from.speed) / t - 2 * from.acceleration - change / 2) / t;
  pair.second = change / t - pair.first;
  pair.middle = {.speed = from.speed + t * (from.acceleration + t * pair.first / 2),
                 .acceleration = from.acceleration + t * pair.first};
  return pair;
}

double JerkProfile::highest(const State& from, double jerk, double time) {
  const bool turns = from.acceleration > 0 && from.acceleration + jerk * time < 0;
  return turns ? from.speed - from.acceleration * from.acceleration / (2 * jerk) : from.speed;
}

// The largest multiples of the limits.
JerkProfile::Excess JerkProfile::excess(std::size_t i) const {
  const Pair pair = pair_of(i);
  if (!(pair.half > 0) || pair.middle.speed < 0) return {2, 2};
  const State from = state(i);
  const State to = state(i + 1);
  const JerkCell& cell = cells_[i];
  // Straight pieces are rounded above the low place between them: where a jump is to stay unseen, too much.
  if (from.speed * from.speed > most_above_cap * cap_[i]) return {2, 0};
  const double top =
      std::max({to.speed, highest(from, pair.first, pair.half), highest(pair.middle, pair.second, pair.half)});
  Excess worst;
  if (cell.straight) {
    const double jerk = std::max(std::abs(pair.first), std::abs(pair.second)) / cell.jerk;
    const double acceleration =
        std::max({std::abs(from.acceleration), std::abs(to.acceleration), std::abs(pair.middle.acceleration)}) /
        cell.acceleration;
    return {std::max(acceleration, top / std::sqrt(cell.top_squared)), jerk};
  }
  const AxisShape* shape = shapes(i);
  const double share =
      pair.half * (from.speed + pair.half * (from.acceleration / 2 + pair.half * pair.first / 6)) / cell.length;
  worst.force = top * top / cell.top_squared;
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const double third = shape->third_in + share * (shape->third_out - shape->third_in);
    const double bend = shape->bend_in + share * (shape->bend_out - shape->bend_in);
    const double slope = shape->slope_in + share * (shape->slope_out - shape->slope_in) -
                         cell.length * cell.length * share * (1 - share) / 2 * third;
    const auto see = [&](double first, double second, double third_here, const State& at, double jerk) {
      const double v = at.speed;
      const double force = std::abs(first * at.acceleration + second * v * v) / (axes_[k].acceleration * looked_at);
      const double jolt = std::abs(first * jerk + 3 * second * v * at.acceleration + third_here * v * v * v) /
                          (axes_[k].jerk * looked_at);
      worst.force = std::max(worst.force, force);
      worst.jolt = std::max(worst.jolt, jolt);
    };
    see(shape->slope_in, shape->bend_in, shape->third_in, from, pair.first);
    see(slope, bend, third, pair.middle, pair.first);
    see(slope, bend, third, pair.middle, pair.second);
    see(shape->slope_out, shape->bend_out, shape->third_out, to, pair.second);
  }
  return worst;
}

// Around every place beyond its limits: less jerk is planned with, then less speed; wider and more the longer it takes.
bool JerkProfile::lower_where_exceeded(int round) {
  const std::size_t n = cells_.size();
  exceeded_.clear();
  const auto reach = static_cast<std::size_t>(round / 5);
  const double most = round < 8 ? 0.8 : round < 16 ? 0.6 : 0.3;
  const double least = round < 4 ? 0.98 : round < 8 ? 0.95 : 0.9;
  for (std::size_t i = 0; i < n; ++i) {
    if (round > 0 && checked_.size() == x_.size() && is_as_checked(i)) continue;
    const Excess worst = excess(i);
    if (worst.force <= accepted && worst.jolt <= accepted) continue;
    exceeded_.push_back(i);
    if (!(pair_of(i).half > 0)) flatten(i);
    const double slower = std::clamp(1 / std::max(worst.force, std::cbrt(worst.jolt * worst.jolt)), most, least);
    const double gentler = std::clamp(1 / worst.jolt, most, least);
    const std::size_t from = i > reach ? i - reach : 0;
    const std::size_t to = std::min(i + 1 + reach, n);
    for (std::size_t k = from; k <= to; ++k) {
      if (worst.jolt > accepted) share_[k] = std::max(share_[k] * gentler, least_share);
      if (worst.force > accepted || round % 4 == 3) cap_[k] = std::min(cap_[k], x_[k] * slower);
    }
  }
  checked_.assign(x_.begin(), x_.end());
  for (const std::size_t i : exceeded_) checked_[i] = -1;
  return !exceeded_.empty();
}

// Too much change within one cell, at whatever speed.
void JerkProfile::flatten(std::size_t i) {
  const double most = most_growth * std::min(x_[i], x_[i + 1]);
  cap_[i] = std::min(cap_[i], most);
  cap_[i + 1] = std::min(cap_[i + 1], most);
}

// A cell's phases follow from four nodes.
bool JerkProfile::is_as_checked(std::size_t i) const {
  const std::size_t from = i > 0 ? i - 1 : 0;
  const std::size_t to = std::min(i + 2, cells_.size());
  for (std::size_t k = from; k <= to; ++k) {
    if (x_[k] != checked_[k]) return false;
  }
  return true;
}

void JerkProfile::add_phases(std::size_t i, PlannedMove& move) const {
  const Pair pair = pair_of(i);
  const State from = state(i);
  const JerkCell& cell = cells_[i];
  const double change = std::max(std::abs(pair.first), std::abs(pair.second)) * pair.half;
  if (change <= unseen_change * std::min(cell.acceleration, weak) && from.speed > 0 && x_[i + 1] > 0) {
    add_steady(cell, from, state(i + 1).speed, move);
    return;
  }
  const double way = pair.half * (from.speed + pair.half * (from.acceleration / 2 + pair.half * pair.first / 6));
  move.add({.duration = Seconds(pair.half),
            .start = Mm(cell.start),
            .velocity = MmPerSecond(from.speed),
            .acceleration = MmPerSecond2(from.acceleration),
            .jerk = MmPerSecond3(pair.first)});
  move.add({.duration = Seconds(pair.half),
            .start = Mm(cell.start + way),
            .velocity = MmPerSecond(pair.middle.speed),
            .acceleration = MmPerSecond2(pair.middle.acceleration),
            .jerk = MmPerSecond3(pair.second)});
}

// Without jerk; what goes on as the phase before did makes that longer.
void JerkProfile::add_steady(const JerkCell& cell, const State& from, double exit, PlannedMove& move) const {
  Phase phase{.duration = Seconds(0),
              .start = Mm(cell.start),
              .velocity = MmPerSecond(from.speed),
              .acceleration = MmPerSecond2(0),
              .jerk = MmPerSecond3(0)};
  if (move.phase_count > 0) {
    const Phase& before = move.phases[move.phase_count - 1];
    if (before.jerk == MmPerSecond3(0) && std::abs(before.acceleration.value() - from.acceleration) <=
                                              4 * unseen_change * std::min(cell.acceleration, weak)) {
      phase = before;
      --move.phase_count;
    }
  }
  const double way = cell.start + cell.length - phase.start.value();
  phase.duration = Seconds(2 * way / (phase.velocity.value() + exit));
  phase.acceleration = MmPerSecond2((exit - phase.velocity.value()) / phase.duration.value());
  move.add(phase);
}

void JerkProfile::drop(std::size_t count) {
  if (count == 0) return;
  const bool all = count == cells_.size();
  if (!all) start_ = state(count);
  const auto n = static_cast<std::ptrdiff_t>(count);
  cells_.erase(cells_.begin(), cells_.begin() + n);
  shapes_.erase(shapes_.begin(), shapes_.begin() + n * static_cast<std::ptrdiff_t>(axes_.size()));
  entry_cap_.erase(entry_cap_.begin(), entry_cap_.begin() + n);
  entry_share_.erase(entry_share_.begin(), entry_share_.begin() + n);
  x_.erase(x_.begin(), x_.begin() + n);
  planned_ -= std::min(planned_, count);
  frozen_ = all || x_[0] <= 0 ? 0 : 1;
  if (all) x_.clear();
}

}  // namespace passo
