#include "jerk_profile.hpp"

#include <cmath>

#include "arithmetic.hpp"

namespace passo {
namespace {

// A share of the limits. Demands are larger between the places that JerkOptimizer looks at. Of 400 random programs
// those with limits of jerk take up to 0.8 % less time than with 0.985 in bends, for 5 % more instructions.
constexpr double planned_share = 0.998;
// A guess needs room on all sides, or the lift begins with steps that are hardly any.
constexpr double guessed_speed_squared = 0.7;
constexpr double guessed_acceleration = 0.5;
constexpr double hardest_guessed_braking = 0.9;
constexpr double guessed_jerk = 0.5;
constexpr double most_growth = 2.5;  // of the square of a guessed speed, from node to node
constexpr int most_passes = 40;
constexpr std::size_t most_splits = 16;  // the window is no longer split when it has so many times its cells
constexpr double at_cap = 1 - 1e-9;
constexpr double rises_to_settle = 1;  // times the rise of the acceleration from 0 to its limit
constexpr double room_to_lift = 0.5;   // for squares of speeds: with that all limits have room
constexpr int most_lifts = 8;
constexpr std::size_t wider = 32;       // nodes on each side, where a part between steady nodes cannot be lifted
constexpr double worth_of_lift = 0.98;  // of the time: a further lift is worth it

// Where a cell exceeds a limit, the share is lowered to what would have been right, in these bounds.
constexpr double least_lowering_of_share = 0.995;
constexpr double most_lowering_of_share = 0.7;
constexpr double safely = 0.998;
constexpr double lower_cap = 0.9995;
// Of the square of a speed. A deeper notch in an even cap makes the acceleration go to and fro beside it, and then the
// cells there exceed the cap: with 0.9995 a slow program with soft limits of jerk took six times as long to plan.
constexpr double lower_pace = 0.9999;
// Of the square of a speed: above its cap by so little it is lowered as it is, without a lift.
constexpr double most_trimmed = 1.01;
constexpr std::size_t nearby = 14;  // cells on both sides of one that are lifted again with it
constexpr int rounds_nearby = 4;    // later rounds take more cells
constexpr double beyond = 0.9999;   // slowed a little more, against rounding
constexpr int most_slowings = 40;

constexpr double strong_braking = 0.05;  // share of the limit
constexpr double settling = 0.5;         // share of the time of the final braking
// Where the path is slow, braking takes a few cells only. The next window then began with speeds and accelerations so
// near to its first limits that it could not keep them, and the motion came to rest there.
constexpr std::size_t fewest_undecided = 32;

}  // namespace

void JerkProfile::push(const JerkCell& cell, const AxisShape* shapes) {
  cells_.push_back(cell);
  shapes_.insert(shapes_.end(), shapes, shapes + axes_.size());
  entry_cap_.push_back(constant_speed_cap(cells_.size() - 1));
}

// The highest x at the node with which a constant speed keeps every limit.
double JerkProfile::constant_speed_cap(std::size_t node) const {
  double cap = passing_cap(node);
  const AxisShape* shape = shapes(node);
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const double bend = std::abs(shape->bend_in);
    const double third = std::abs(shape->third_in);
    if (bend > 0) cap = std::min(cap, axes_[k].turning_cap(std::abs(shape->slope_in), bend, planned_share));
    if (third > 0) cap = std::min(cap, std::pow(planned_share * axes_[k].jerk / third, 2.0 / 3));
  }
  return cap;
}

void JerkProfile::begin_in_motion(const NodeState& state) {
  states_.assign(1, state);
  ends_.in_motion = true;
  planned_ = 0;
}

// The greatest x with which each axis keeps to its velocity, by the axes' slopes at a place of the cell.
double JerkProfile::velocity_cap(std::size_t cell, double (*slope)(const AxisShape&, double length)) const {
  if (cells_[cell].straight) return cells_[cell].top_squared;
  double fastest_axis = 0;  // as a multiple of the velocity
  const AxisShape* shape = shapes(cell);
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    fastest_axis = std::max(fastest_axis, std::abs(slope(*shape, cells_[cell].length)) / axes_[k].velocity);
  }
  return std::min(cells_[cell].top_squared, 1 / (fastest_axis * fastest_axis));
}

// The cap by feed, velocities and jumps of the bend, which no acceleration changes.
double JerkProfile::passing_cap(std::size_t node) const {
  const std::size_t n = cells_.size();
  if (node == n) return 0;
  double cap = velocity_cap(node, [](const AxisShape& shape, double) { return shape.slope_in; });
  if (node > 0) {
    cap = std::min(cap, velocity_cap(node - 1, [](const AxisShape& shape, double) { return shape.slope_out; }));
  }
  cap *= planned_velocity * planned_velocity;
  if (node == 0 || (cells_[node - 1].straight && cells_[node].straight)) return cap;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    if (!axes_[k].limits_jerk()) continue;
    const double jump = std::abs(shapes(node)[k].bend_in - shapes(node - 1)[k].bend_out);
    if (jump * cap > unseen_jump * axes_[k].acceleration) cap = unseen_jump * axes_[k].acceleration / jump;
  }
  return cap;
}

void JerkProfile::prepare() {
  const std::size_t n = cells_.size();
  passing_cap_.resize(n + 1);
  for (std::size_t k = 0; k <= n; ++k) passing_cap_[k] = passing_cap(k);
  node_cap_ = passing_cap_;
  cell_cap_.clear();
  share_.assign(n, planned_share);
  for (std::size_t i = 0; i < n; ++i) {
    const double cap =
        velocity_cap(i, [](const AxisShape& shape, double length) { return shape.slope_middle(length); });
    cell_cap_.push_back(cap * planned_velocity * planned_velocity);
  }
}

// What the axes allow along the path at that square of the speed. Where the torque falls and the guess did not know it,
// steady nodes were too near to corners, and most parts between them could not be lifted.
double JerkProfile::acceleration_at(std::size_t cell, double x) const {
  double most = cells_[cell].acceleration;
  if (!any_falls_) return most;
  const AxisShape* shape = shapes(cell);
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const double slope = std::max(std::abs(shape->slope_in), std::abs(shape->slope_out));
    if (slope > 0) most = std::min(most, axes_[k].acceleration_at(slope * slope * x) / slope);
  }
  return most;
}

// The highest x along the cells from a rest on, or from the state of a window that begins in motion.
void JerkProfile::guess_from(std::size_t node, bool backwards, double growth) {
  std::vector<double>& x = guess_;
  const std::size_t n = cells_.size();
  const bool from_rest = x[node] == 0;
  double way = 0;  // from the rest
  for (std::size_t left = n; left-- > 0;) {
    const std::size_t next = backwards ? node - 1 : node + 1;
    const JerkCell& cell = cells_[std::min(node, next)];
    way += cell.length;
    const double acceleration = guessed_acceleration * acceleration_at(std::min(node, next), x[node]);
    double most = x[node] + 2 * acceleration * cell.length;
    if (x[node] > 0) most = std::min(most, growth * x[node]);
    if (from_rest) {
      // With constant jerk from rest, x = (j² (6 s)⁴)^(1/3) / 4.
      const double jerk = guessed_jerk * cell.jerk;
      const double sixfold = 6 * way;
      const double with_jerk = std::cbrt(jerk * sixfold * jerk * sixfold) * std::cbrt(sixfold * sixfold) / 4;
      // Where cells before had more jerk, the motion is faster already, and may stay so. In the first cell the
      // acceleration at the other node is 2 x / 3 s.
      most = std::min(x[node] > 0 ? most : 1.5 * acceleration * cell.length, std::max(with_jerk, x[node]));
    }
    x[next] = std::min(x[next], most);
    node = next;
  }
}

// The motion slows down steeply before a slow place. Cells become shorter towards that place, so that the speed changes
// evenly from cell to cell.
void JerkProfile::grade() {
  prepare();
  exceeded_.clear();
  for (int pass = 0; pass < most_passes; ++pass) {
    guess(guessed_speed_squared, infinity);
    if (!split_coarse()) return;
    prepare();
  }
}

double JerkProfile::most_at_start() const {
  return ends_.in_motion ? states_[0].speed * states_[0].speed : stop_at(true).square;
}

// Puts `guess_` at this share of the squares of the caps, or lower where it takes longer to get there.
void JerkProfile::guess(double share, double growth) {
  const std::size_t n = cells_.size();
  guess_.assign(n + 1, 0.0);
  const double start = most_at_start();
  const double end = stop_at(false).square;
  for (std::size_t k = 0; k < n; ++k) guess_[k] = share * std::min(entry_cap_[k], node_cap_[k]);
  guess_[0] = start;
  guess_[n] = end;
  guess_from(n, true, growth);
  if (ends_.in_motion) guess_[0] = start;
  guess_from(0, false, growth);
  // A window that begins in motion cannot brake harder than that.
  double least = ends_.in_motion ? guess_[0] : 0;
  for (std::size_t k = 1; k < n && guess_[k] < least; ++k) {
    least -= 2 * hardest_guessed_braking * cells_[k - 1].acceleration * cells_[k - 1].length;
    guess_[k] = std::max(guess_[k], least);
  }
}

// Makes the states a gentle motion that may grow only slowly from node to node.
void JerkProfile::begin_with_guess() {
  guess(guessed_speed_squared, most_growth);
  const std::vector<double>& x = guess_;
  const std::size_t n = cells_.size();
  const NodeState front =
      ends_.in_motion ? states_[0] : NodeState{.speed = std::sqrt(x[0]), .acceleration = stop_at(true).bend * x[0]};
  states_.resize(n + 1);
  for (std::size_t k = 1; k < n; ++k) {
    const double before = cells_[k - 1].length;
    const double after = cells_[k].length;
    const double slope_before = (x[k] - x[k - 1]) / (2 * before);
    const double slope_after = (x[k + 1] - x[k]) / (2 * after);
    double acceleration = (slope_before * after + slope_after * before) / (before + after);
    if (x[k - 1] == 0 && k == 1) acceleration = slope_before * 4 / 3;
    if (x[k + 1] == 0) acceleration = slope_after * 4 / 3;
    states_[k] = {.speed = std::sqrt(x[k]), .acceleration = acceleration};
  }
  states_[0] = front;
  states_[n] = {.speed = std::sqrt(x[n]), .acceleration = stop_at(false).bend * x[n]};
}

double JerkProfile::duration(std::size_t i) const {
  return 2 * cells_[i].length / (states_[i].speed + states_[i + 1].speed);
}

double JerkProfile::time() const {
  double sum = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) sum += duration(i);
  return sum;
}

bool JerkProfile::lift(const Stretch& stretch) {
  return lift_.raise({.cells = cells_,
                      .shapes = shapes_,
                      .share = share_,
                      .cap = cell_cap_,
                      .node_cap = node_cap_,
                      .begins = stretch.first == 0 && !ends_.in_motion ? stop_at(true) : JerkOptimizer::Stop{},
                      .ends = stretch.last == cells_.size() ? stop_at(false) : JerkOptimizer::Stop{}},
                     stretch.first, stretch.last, states_);
}

// Lowers the speeds of a cell that is too fast only, and by little, to its cap. Returns whether it and the cell before
// keep their limits then; else nothing changes. The cell after is looked at later, if it is in the same stretch.
bool JerkProfile::trim(std::size_t i, const Excess& worst, const Stretch& lifted) {
  if (worst.pace > most_trimmed || std::max(worst.force, worst.jolt) > 1 || (i == 0 && ends_.in_motion)) return false;
  // At a stop the acceleration belongs to the speed.
  if ((i == 0 && states_[0].acceleration != 0) || (i + 1 == cells_.size() && states_[i + 1].acceleration != 0)) {
    return false;
  }
  const NodeState in = states_[i];
  const NodeState out = states_[i + 1];
  const double factor = std::sqrt(lower_pace / worst.pace);
  states_[i].speed *= factor;
  states_[i + 1].speed *= factor;
  const bool is_last = i + 1 == lifted.last && i + 1 < cells_.size();
  if (excess(i).most() <= 1 && (i == 0 || excess(i - 1).most() <= 1) && (!is_last || excess(i + 1).most() <= 1)) {
    return true;
  }
  states_[i] = in;
  states_[i + 1] = out;
  return false;
}

void JerkProfile::find_exceeded(const Stretch& lifted) {
  for (std::size_t i = lifted.first; i < lifted.last; ++i) {
    const Excess worst = excess(i);
    const double most = worst.most();
    if (most <= 1 || trim(i, worst, lifted)) continue;
    exceeded_.push_back(i);
    if (std::max(worst.force, worst.jolt) > 1)
      share_[i] *= std::clamp(safely / most, most_lowering_of_share, least_lowering_of_share);
    if (worst.force > 1) {  // the speed may be the reason
      cell_cap_[i] *= lower_cap;
      node_cap_[i] *= lower_cap;
    }
    if (worst.pace <= 1) continue;
    for (double* const cap : {&cell_cap_[i], &node_cap_[i], &node_cap_[i + 1]}) *cap *= lower_pace / worst.pace;
  }
}

// Lifts cells that exceed a limit again, with a smaller share of the limits. Returns whether none is left.
bool JerkProfile::mend() {
  const Stretch all{.first = 0, .last = cells_.size()};
  again_.assign(1, all);
  for (int round = 0;; ++round) {
    exceeded_.clear();
    for (const Stretch& lifted : again_) find_exceeded(lifted);
    if (exceeded_.empty()) return true;
    if (round >= effort_.rounds) return false;
    again_.clear();
    const std::size_t beside = round < rounds_nearby ? nearby : 4 * nearby;
    for (std::size_t k = 0; k < exceeded_.size();) {
      Stretch around{.first = std::max(exceeded_[k], beside) - beside, .last = exceeded_[k]};
      while (k < exceeded_.size() && exceeded_[k] <= around.last + beside) around.last = exceeded_[k++];
      around.last = std::min(around.last + 1 + beside, all.last);
      again_.push_back(around);
      // If no solution is found, the next round finds the excess again and lifts more cells with it.
      static_cast<void>(lift(around));
    }
  }
}

// The factor for squares of speeds with which no cell exceeds a limit. 0: some cell has no phases at all.
double JerkProfile::slowing() const {
  double most = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (!is_possible(pair_of(i), states_[i])) return 0;
    const Excess worst = excess(i);
    most = std::max({most, worst.force, worst.pace, std::cbrt(worst.jolt * worst.jolt)});
  }
  return most <= 1 ? 1 : beyond / most;
}

void JerkProfile::slow_by(double factor) {
  for (NodeState& state : states_) {
    state.speed *= std::sqrt(factor);
    state.acceleration *= factor;
  }
}

// Slows the motion as a whole. Returns whether all limits are kept then.
bool JerkProfile::slow_down() {
  for (int round = 0; round < most_slowings; ++round) {
    const double factor = slowing();
    if (factor == 1) return true;
    if (factor == 0) return false;
    slow_by(factor);
  }
  return false;
}

// Finds the nodes that are surely passed at the cap without acceleration: where the speed is steady, and so far from
// all other nodes that even a gentle rise of the speed is over.
void JerkProfile::find_steady() {
  const std::size_t n = cells_.size();
  guess(1, infinity);
  const auto is_flat = [this](std::size_t k) {
    return guess_[k] >= node_cap_[k] * at_cap && node_cap_[k - 1] == node_cap_[k] && node_cap_[k + 1] == node_cap_[k];
  };
  steady_.assign(n + 1, false);
  steady_[0] = ends_.in_motion && guess_[0] >= node_cap_[0] * at_cap && states_[0].acceleration == 0;
  for (std::size_t k = 1; k < n; ++k) steady_[k] = is_flat(k);
  // Widens what is not steady by the time in which the acceleration can change, in both directions.
  double left = narrow_steady(0, 0, infinity);
  for (std::size_t k = 1; k <= n; ++k) left = narrow_steady(k, k - 1, left);
  left = infinity;
  for (std::size_t k = n; k-- > 0;) left = narrow_steady(k, k, left);
}

// The node is steady only if that much time has passed since the last node that is not. Returns the time that is left.
double JerkProfile::narrow_steady(std::size_t node, std::size_t cell, double left) {
  if (!steady_[node]) return rises_to_settle * cells_[cell].acceleration / cells_[cell].jerk;
  if (std::isinf(left)) return left;
  left -= cells_[cell].length / std::sqrt(node_cap_[node]);
  if (left > 0) steady_[node] = false;
  return left > 0 ? left : infinity;
}

// Lifts each part of the window between steady nodes.
bool JerkProfile::lift_between_steady() {
  const std::size_t n = cells_.size();
  for (std::size_t k = 1; k < n; ++k) {
    if (steady_[k]) states_[k] = {.speed = std::sqrt(node_cap_[k]), .acceleration = 0};
  }
  for (Stretch part; part.last < n;) {
    part.first = part.last++;
    while (part.last < n && !steady_[part.last]) ++part.last;
    if (part.last > part.first + 1 && !lift_wider(part)) return false;
  }
  return true;
}

// Lifts a part between steady nodes. If that fails, steady nodes on both sides may be too near: the cap is reached
// later than the guess says. Then the part takes in some of them.
bool JerkProfile::lift_wider(Stretch& part) {
  if (lift(part)) return true;
  const auto loosen = [this](std::size_t node) {
    steady_[node] = false;
    states_[node] = {.speed = std::sqrt(guess_[node]), .acceleration = 0};
  };
  const std::size_t n = cells_.size();
  const Stretch before = part;
  while (part.first > 0 && before.first - part.first < wider && steady_[part.first - 1]) loosen(part.first--);
  while (part.last < n && (part.last - before.last < wider || !steady_[part.last])) loosen(part.last++);
  if (part.first == before.first && part.last == before.last) return false;
  return lift(part);
}

// Finds a motion over all cells that keeps the limits.
bool JerkProfile::find_motion() {
  find_steady();
  for (int attempt = 0; attempt < effort_.attempts; ++attempt) {
    begin_with_guess();
    const bool is_lifted = attempt == 0 ? lift_between_steady() : lift({.first = 0, .last = cells_.size()});
    if (is_lifted && mend()) return true;
    if (!is_lifted) exceeded_.clear();
    for (std::size_t k = 0; k < states_.size(); ++k) guess_[k] = states_[k].speed * states_[k].speed;
    // The next attempt begins with the same guess. It is another one only if cells or stretches are.
    const bool was_whole = attempt > 0 || std::ranges::find(steady_, true) == steady_.end();
    if (!split_coarse() && was_whole) break;
    prepare();
  }
  return !ends_.in_motion && find_motion_from_slow();
}

// Begins with a motion that keeps all limits, and lifts it as far as it goes.
bool JerkProfile::find_motion_from_slow() {
  prepare();
  begin_with_guess();
  if (!slow_down()) {
    even_out();
    prepare();
    begin_with_guess();
    for (NodeState* const end : {&states_.front(), &states_.back()}) {
      if (end->acceleration != 0) end->speed = 0;
    }
    for (NodeState& state : states_) state.acceleration = 0;  // then every cell has phases
    if (!slow_down()) return false;
  }
  kept_ = states_;
  slow_by(room_to_lift);
  double before = infinity;
  for (int i = 0; i < most_lifts && lift({.first = 0, .last = cells_.size()}) && time() < worth_of_lift * before; ++i) {
    before = time();
  }
  if (!mend() && !slow_down()) states_ = kept_;
  return true;
}

std::size_t JerkProfile::plan(bool closed, double end_squared) {
  ends_.end_squared = closed ? end_squared : 0;
  kept_.assign(states_.begin(), states_.end());
  if (cells_.size() < fewest_cells && planned_ == 0) even_out();
  effort_.most_cells = most_splits * cells_.size();
  grade();
  const bool fell_back_before = fell_back_;
  fell_back_ = !find_motion();
  if (fell_back_) return go_on_as_planned(fell_back_before);
  planned_ = cells_.size();
  return closed ? planned_ : decided_of_open();
}

// The plan's end is not the path's. What depends on the end is not decided: the braking for it, and some time and some
// cells before.
std::size_t JerkProfile::decided_of_open() const {
  std::size_t k = cells_.size();
  double braking = 0;
  while (k > 0 && (k == cells_.size() || states_[k].acceleration < -strong_braking * cells_[k].acceleration)) {
    braking += duration(--k);
  }
  for (double time = 0; k > 0 && time < settling * braking;) time += duration(--k);
  if (cells_.size() >= 4 * fewest_undecided) k = std::min(k, cells_.size() - fewest_undecided);
  return k >= 2 ? k : 0;
}

// Goes on with the last good plan, which ends at rest at the end of the path known then. Half of it is played; all of
// it if that did not help before. Each attempt plans the whole window.
std::size_t JerkProfile::go_on_as_planned(bool again) {
  states_.assign(kept_.begin(), kept_.end());
  states_.resize(cells_.size() + 1);
  std::fill(states_.begin() + static_cast<std::ptrdiff_t>(planned_) + 1, states_.end(), NodeState{});
  return std::max<std::size_t>(again ? planned_ : planned_ / 2, 1);
}

void JerkProfile::drop(std::size_t count) {
  if (count == 0) return;
  const auto n = static_cast<std::ptrdiff_t>(count);
  const bool all = count == cells_.size();
  cells_.erase(cells_.begin(), cells_.begin() + n);
  shapes_.erase(shapes_.begin(), shapes_.begin() + n * static_cast<std::ptrdiff_t>(axes_.size()));
  entry_cap_.erase(entry_cap_.begin(), entry_cap_.begin() + n);
  states_.erase(states_.begin(), states_.begin() + std::min(n, static_cast<std::ptrdiff_t>(states_.size())));
  planned_ -= std::min(planned_, count);
  ends_.in_motion = !all && states_[0].speed > 0;
  if (all) states_.clear();
  ends_.start_squared = 0;
}

}  // namespace passo
