#include "jerk_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passo {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Shares of the limits to plan with. The rest is for what straight pieces do not see, and for raising. A plan with some
// distance from the limits needs fewer repairs, and the raised motion is no slower.
constexpr double planned_jerk = 0.86;
constexpr double planned_acceleration = 0.96;
constexpr double constant_speed_jerk = 0.84;  // share of the jerk limit, for the path's bends alone
constexpr double most_unevenness = 2.5;
constexpr int rounds_a_refinement = 10;
constexpr double least_left =
    0.01;  // share of the square of a speed; a rest where the path does not rest would last for ever
constexpr std::size_t most_undecided = 600;  // cells in which a calm place is looked for

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
      if (any_falls_ && axes_[k].falling != nullptr) {
        const double slope = std::max(std::abs(shapes[k].slope_in), joined ? std::abs(before[k].slope_out) : 0);
        cap = std::min(cap, axes_[k].turning_cap(slope, bend, planned_acceleration));
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

void JerkProfile::begin_in_motion(double speed) {
  start_ = {.speed = speed, .acceleration = 0};
  x_.assign(2, speed * speed);
  frozen_ = 1;
  planned_ = 0;
}

double JerkProfile::duration(std::size_t i) const {
  const double sum = std::sqrt(x_[i]) + std::sqrt(x_[i + 1]);
  return sum > 0 ? 2 * cells_[i].length / sum : 0;
}

// Narrows `range` to the jerk along the path that the axes leave: |q' j + 3 q'' v a + q''' v³| <= J.
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

// The largest slope of a cell for which every axis has the acceleration. Backwards: the steepest fall, with its sign
// turned. `near` is x where the step begins.
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

// The same under limits that fall with the speed, with the line of each limit that is the highest at `near`.
double JerkProfile::most_under_falling(std::size_t i, bool backwards, double near) const {
  double most = infinity;
  const AxisShape* shape = shapes(i);
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    if (axes_[k].falling == nullptr) continue;
    const double near_slope = backwards ? -shape->slope_out : shape->slope_in;
    const double near_bend = backwards ? shape->bend_out : shape->bend_in;
    const double far_slope = backwards ? -shape->slope_in : shape->slope_out;
    const double far_bend = backwards ? shape->bend_in : shape->bend_out;
    // Limits the slope where x is `near` + `way` times the slope.
    const auto meet = [&](double slope, double bend, double way) {
      const double weight = slope * slope;
      if (!axes_[k].falls_at(weight * near)) return;
      const AccelerationCurve::Line& line = axes_[k].line_at(weight * near);
      const double fall = planned_acceleration * line.fall * weight;
      const double left = planned_acceleration * line.at_rest - fall * near;
      const double factor = slope + way * bend;
      const double up = way * fall + factor;
      const double down = way * fall - factor;
      if (up > 0) most = std::min(most, (left - bend * near) / up);
      if (down > 0) most = std::min(most, (left + bend * near) / down);
    };
    meet(near_slope, near_bend, 0);
    meet(far_slope, far_bend, 2 * cells_[i].length);
  }
  return most;
}

// Steps across cell i, with the acceleration rising as fast as it may. Returns whether the profile is at its cap there,
// and its slope does not matter beyond.
bool JerkProfile::step(std::size_t i, bool backwards, March& march) const {
  const std::size_t near = backwards ? i + 1 : i;
  const std::size_t far = backwards ? i : i + 1;
  const double h = cells_[i].length;
  double most = most_acceleration(i, backwards, march.x);
  if (any_falls_ && !cells_[i].straight) most = std::min(most, most_under_falling(i, backwards, march.x));
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
  const std::size_t n = cells_.size();
  const std::size_t first = frozen_ > 0 ? 1 : 0;
  std::size_t i = first;
  if (changed_.all) {
    forwards_[0] = {.x = cap_[0]};
    if (frozen_ > 0) forwards_[1] = {.x = x_[1], .slope = slope(0), .half = duration(0) / 2};
  } else {
    i = std::max(first, changed_.from > 0 ? changed_.from - 1 : 0);
  }
  for (; i < n; ++i) {
    March march = forwards_[i];
    step(i, false, march);
    if (!changed_.all && i >= changed_.to && march == forwards_[i + 1]) return;
    forwards_[i + 1] = march;
  }
}

// Lowers x_ to what braking allows. Returns the last node that does not depend on motion still to come. Only a pass
// over the whole window tells.
std::size_t JerkProfile::go_backwards(bool closed) {
  const std::size_t n = cells_.size();
  const std::size_t first = frozen_ > 0 ? 1 : 0;
  std::size_t decided = closed ? n : 0;
  std::size_t i = n;
  if (changed_.all) {
    backwards_[n] = {.x = cap_[n]};
  } else {
    i = std::min(n, changed_.to + 1);
  }
  while (i-- > first) {
    March march = backwards_[i + 1];
    const bool free = step(i, true, march);
    if (free && decided == 0) decided = i;
    if (!changed_.all && i + 1 <= changed_.from && march == backwards_[i]) break;
    backwards_[i] = march;
    if (i == first && frozen_ > 0 && march.x < x_[i] * (1 - 1e-9)) return cannot_brake;
  }
  for (std::size_t k = frozen_ > 0 ? 2 : 0; k <= n; ++k) x_[k] = std::min(backwards_[k].x, forwards_[k].x);
  return decided;
}

// The greatest drop of the slope at a node.
double JerkProfile::drop_at(std::size_t node) const {
  const double v = std::sqrt(x_[node]);
  const double time = (duration(node - 1) + duration(node)) / 2;
  const double before = slope(node - 1);
  const double after = slope(node);
  const double low = std::max(jerk_range(node, v, before).low, jerk_range(node, v, after).low);
  return std::max(-low, 0.0) * time;
}

// A drop follows from three nodes. It stays the same where those are unchanged.
void JerkProfile::find_drops(std::size_t from) {
  const auto is_same = [this](std::size_t k) { return x_[k] == uncut_[k]; };
  for (std::size_t i = from; i < cells_.size(); ++i) {
    const bool in_changed = changed_.all || (i >= changed_.from && i <= changed_.to);
    if (in_changed || !is_same(i - 1) || !is_same(i) || !is_same(i + 1)) drops_[i] = x_[i] > 0 ? drop_at(i) : 0;
  }
  uncut_.assign(x_.begin(), x_.end());
}

void JerkProfile::cut_corners() {
  const std::size_t n = cells_.size();
  const std::size_t first = frozen_ > 0 ? 1 : 0;
  find_drops(first + 1);
  std::vector<double>& y = raised_;
  std::size_t begin = first;
  hull_.clear();
  while (begin < n) {
    std::size_t end = begin + 1;
    while (end < n && x_[end] > 0) ++end;
    // Between rests: y = x + G, where the slope of G grows by the drops.
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
        x_[i] = std::clamp(lowered, least_left * x_[i], x_[i]);
      }
    }
    begin = end;
    if (begin < n) hull_.pop_back();  // this rest is also the start of the next part
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
  backwards_.resize(n + 1);
  raised_.resize(n + 1);
  uncut_.resize(n + 1);
  changed_ = {};
  is_raised_ = false;
  x_.resize(n + 1, 0.0);
  drops_.resize(n + 1);
  place_.resize(n + 1);
  place_[0] = 0;
  for (std::size_t i = 0; i < n; ++i) place_[i + 1] = place_[i] + cells_[i].length;
  find_passing_caps();
}

// Splits a cell in two halves.
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
    cap = std::min(cap, axes_[k].turning_cap(last.slope_in, std::abs(last.bend_in), planned_acceleration));
    const double third = std::abs(last.third_in);
    if (third > 0) cap = std::min(cap, std::pow(constant_speed_jerk * axes_[k].jerk / third, 2.0 / 3));
  }
  entry_cap_.insert(at(entry_cap_, i + 1), cap);
  entry_share_.insert(at(entry_share_, i + 1), planned_jerk);
}

// From rest there is no plan to fall back on. Finer cells make one possible.
void JerkProfile::refine() {
  for (std::size_t k = exceeded_.size(); k-- > 0;) {
    const std::size_t i = exceeded_[k];
    const bool apart = k + 1 == exceeded_.size() || exceeded_[k + 1] > i + 1;
    if (apart && i + 1 < cells_.size()) split(i + 1);
    split(i);
    if (i > 0 && (k == 0 || exceeded_[k - 1] + 2 < i)) split(i - 1);
  }
  even_out();
  prepare();
}

// The acceleration cannot change evenly where a long cell meets a short one. All of the change would fall into the
// short cell, and the finer that is cut, the more jerk it needs.
void JerkProfile::even_out() {
  const auto is_long = [this](std::size_t i) {
    const double length = cells_[i].length / most_unevenness;
    return (i > 0 && length > cells_[i - 1].length) || (i + 1 < cells_.size() && length > cells_[i + 1].length);
  };
  for (std::size_t i = 0; i < cells_.size();) {
    if (is_long(i)) {
      split(i);
      i -= std::min<std::size_t>(i, 1);
    } else {
      ++i;
    }
  }
}

std::size_t JerkProfile::plan(bool closed) {
  prepare();
  kept_.assign(x_.begin(), x_.end());
  std::size_t decided = 0;
  bool good = false;
  bool new_cells = true;  // cells were cut since `decided` was counted
  for (int round = 0; round < most_repairs_ && !good; ++round) {
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
    changed_ = {.all = false, .from = cells_.size(), .to = 0};
    good = !lower_where_exceeded(round);
    const bool refines = round % rounds_a_refinement == rounds_a_refinement - 1 && round + 1 < most_repairs_;
    if (!good && frozen_ == 0 && refines) {
      refine();
      new_cells = true;
    }
  }
  if (!good && frozen_ == 0) slow_down();
  fell_back_ = !good && frozen_ > 0;
  if (fell_back_) return go_on_as_planned();
  const std::size_t n = cells_.size();
  planned_ = n;
  if (closed) {
    raise(n);
    return n;
  }
  // Find the last chord whose both ends are decided, preferably where nothing was repaired: motion given there needs no
  // repair later.
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
  raise(last);
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

// Goes on with the last good plan, which ends at rest at the end of the path known then. Part of it is played.
std::size_t JerkProfile::go_on_as_planned() {
  x_.assign(kept_.begin(), kept_.end());
  is_raised_ = false;
  std::fill(x_.begin() + static_cast<std::ptrdiff_t>(planned_), x_.end(), 0.0);
  return std::max<std::size_t>(planned_ / 4, 1);
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
  if (is_raised_) states_.erase(states_.begin(), states_.begin() + n);
  planned_ -= std::min(planned_, count);
  frozen_ = all || x_[0] <= 0 ? 0 : 1;
  if (all) x_.clear();
}

}  // namespace passo
