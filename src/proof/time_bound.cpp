#include "time_bound.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo::proof {
namespace {

constexpr double turn_of_a_cell = 0.02;  // radians
constexpr double fewest_cells = 64;      // in a curve that turns
// On a line under falling limits: the cells from rest to full speed, and those of a short line, which stays far below
// that.
constexpr double cells_of_a_ramp = 200;
constexpr double fewest_cells_of_line = 100;
constexpr std::size_t window = 65536;  // cells
constexpr double fastest = 1e12;       // x where there is no limit
constexpr double strongest = 1e12;
// A jump of the velocity by less than this share of an axis's limit is rounding.
constexpr double rounding = 1e-6;
// The path rests where a kink may be passed only below this share of the lowest velocity limit.
constexpr double as_good_as_rest = 1e-3;

double square(double value) {
  return value * value;
}

}  // namespace

TimeBound::TimeBound(const ProofOptions& options) : axes_(options.axes) {
  for (const ProvenAxis& axis : axes_) {
    limits_.emplace_back(axis);
    any_falls_ |= limits_.back().falls();
  }
}

void TimeBound::watch(const PlannedMove& move) {
  const Segment& segment = move.segment;
  if (!segment.curve.has_length() || move.phase_count == 0) return;
  // If a curve comes in parts, the first part counts for all of it.
  const bool begins = !inside_curve_ || (move.from() == Mm(0) && reached_ > Mm(0));
  if (begins) add_curve(segment);
  reached_ = move.to;
  inside_curve_ = move.to.value() < segment.curve.length().value() * (1 - 1e-12);
  if (!inside_curve_ && segment.mode == PathMode::exact_stop) end_stretch();
}

void TimeBound::rest(Seconds dwell) {
  end_stretch();
  time_ += dwell.value();
}

void TimeBound::add_curve(const Segment& segment) {
  const ExactCurve curve(segment.curve);
  const double length = curve.length();
  const double feed = square(segment.speed.value());
  const Joint start = joint_at(curve, 0);
  double scale = 1;
  double kink = fastest;
  if (joint_) {
    scale = start.steepness > 0 ? square(joint_->steepness / start.steepness) : 1;
    kink = kink_cap(*joint_, start);
    double slowest = fastest;
    for (const ProvenAxis& axis : axes_) slowest = std::min(slowest, axis.velocity.value());
    if (kink * square(start.steepness) < square(as_good_as_rest * slowest)) {
      end_stretch();
      scale = 1;
    }
  }
  const std::size_t first = cells_.size();
  const int count = curve.is_line() ? cells_of_line(curve, feed)
                                    : static_cast<int>(std::max(fewest_cells, curve.turning() / turn_of_a_cell));
  const auto place = [&](int i) {
    const double share = static_cast<double>(i) / count;
    if (!any_falls_ || i == count) return length * i / count;
    return length * (1 - std::cos(std::numbers::pi * share)) / 2;
  };
  for (int i = 0; i < count; ++i) add_cell(curve, place(i), place(i + 1), feed);
  Cell& entry = cells_[first];
  entry.entry_scale = scale;
  entry.entry_cap = std::min({entry.entry_cap, kink, first > 0 ? cells_[first - 1].exit_cap * scale : fastest});
  joint_ = joint_at(curve, length);
  if (cells_.size() >= 2 * window) settle(window);
}

// Under constant limits one cell is exact. Else as many as are needed so that the speed changes little in each.
int TimeBound::cells_of_line(const ExactCurve& curve, double feed) const {
  if (!any_falls_) return 1;
  double top = feed;
  double strength = strongest;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double steep = std::abs(curve.at(axes_[i].axis, 0).first);
    if (steep == 0) continue;
    if (axes_[i].velocity.value() > 0) top = std::min(top, square(axes_[i].velocity.value() / steep));
    if (limits_[i].constant() > 0) strength = std::min(strength, limits_[i].constant() / steep);
  }
  return static_cast<int>(
      std::clamp(cells_of_a_ramp * std::sqrt(2 * strength * curve.length() / top), fewest_cells_of_line, 4000.0));
}

void TimeBound::add_cell(const ExactCurve& curve, double from, double to, double feed) {
  Cell cell;
  cell.length = to - from;
  cell.line = curve.is_line() && !any_falls_;
  const bool goes_on = from > 0 && !cells_.empty();
  cell.entry_cap = goes_on ? cells_.back().exit_cap : cap_at(curve, from, feed);
  cell.exit_cap = cap_at(curve, to, feed);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Derivatives q = curve.at(axes_[i].axis, (from + to) / 2);
    cell.first[i] = q.first;
    cell.second[i] = q.second;
  }
  cells_.push_back(cell);
}

TimeBound::Joint TimeBound::joint_at(const ExactCurve& curve, double s) const {
  Joint joint;
  double sum = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    joint.direction[i] = curve.at(axes_[i].axis, s).first;
    sum += square(joint.direction[i]);
  }
  joint.steepness = std::sqrt(sum);
  for (double& part : joint.direction) part = joint.steepness > 0 ? part / joint.steepness : 0;
  return joint;
}

// The greatest x after the joint at which no axis's velocity jumps by more than rounding.
double TimeBound::kink_cap(const Joint& before, const Joint& after) const {
  double cap = fastest;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double jump = std::abs(after.direction[i] - before.direction[i]) * after.steepness;
    if (jump > 0 && axes_[i].velocity.value() > 0)
      cap = std::min(cap, square(rounding * axes_[i].velocity.value() / jump));
  }
  return cap;
}

double TimeBound::cap_at(const ExactCurve& curve, double s, double feed) const {
  double cap = std::min(feed, fastest);
  Row first{};
  Row second{};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Derivatives q = curve.at(axes_[i].axis, s);
    first[i] = q.first;
    second[i] = q.second;
    const double velocity = axes_[i].velocity.value();
    if (velocity > 0 && q.first != 0) cap = std::min(cap, square(velocity / q.first));
  }
  return curve.is_line() ? cap : curvature_cap(first, second, cap);
}

// The largest x for which some u keeps every axis within its acceleration.
double TimeBound::curvature_cap(const Row& first, const Row& second, double most) const {
  const auto possible = [&](double x) {
    double low = -INFINITY;
    double high = INFINITY;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const double limit = limits_[i].at(first[i] * std::sqrt(x));
      if (!(limit > 0)) continue;
      const double pull = second[i] * x;
      if (first[i] == 0) {
        if (std::abs(pull) > limit) return false;
        continue;
      }
      const double a = (-limit - pull) / first[i];
      const double b = (limit - pull) / first[i];
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
    return low <= high;
  };
  if (possible(most)) return most;
  double low = 0;
  double high = most;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (possible(middle) ? low : high) = middle;
  }
  return low;
}

// At the middle u = (next - x) / 2h, and x is the mean of both ends. So a limit reads |α next + β x| ≤ A.
TimeBound::Range TimeBound::next_of(const Cell& cell, double x) const {
  if (any_falls_) return next_under_falling(cell, x);
  Range range{.low = 0, .high = INFINITY};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double limit = axes_[i].acceleration.value();
    if (!(limit > 0)) continue;
    const double steep = cell.first[i] / (2 * cell.length);
    const double alpha = cell.second[i] / 2 + steep;
    const double beta = cell.second[i] / 2 - steep;
    if (alpha == 0) {
      if (std::abs(beta * x) > limit) range.high = -1;
      continue;
    }
    const double a = (-limit - beta * x) / alpha;
    const double b = (limit - beta * x) / alpha;
    range.low = std::max(range.low, std::min(a, b));
    range.high = std::min(range.high, std::max(a, b));
  }
  return range;
}

// The limit at the middle hardly depends on the next x, so a few rounds are enough.
TimeBound::Range TimeBound::next_under_falling(const Cell& cell, double x) const {
  Range range{.low = 0, .high = INFINITY};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!(limits_[i].constant() > 0)) continue;
    const double steep = cell.first[i] / (2 * cell.length);
    const double alpha = cell.second[i] / 2 + steep;
    const double beta = cell.second[i] / 2 - steep;
    const auto limit = [&](double next) {
      return limits_[i].at(cell.first[i] * std::sqrt((x + std::max(next, 0.0)) / 2));
    };
    if (alpha == 0) {
      if (std::abs(beta * x) > limit(x)) range.high = -1;
      continue;
    }
    double low = x;
    double high = x;
    for (int round = 0; round < 6; ++round) {
      low = (-limit(low) * (alpha > 0 ? 1 : -1) - beta * x) / alpha;
      high = (limit(high) * (alpha > 0 ? 1 : -1) - beta * x) / alpha;
    }
    range.low = std::max(range.low, low);
    range.high = std::min(range.high, high);
  }
  return range;
}

// The greatest change of x on a line.
double TimeBound::line_reach(const Cell& cell) const {
  double most = strongest;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double limit = axes_[i].acceleration.value();
    if (limit > 0 && cell.first[i] != 0) most = std::min(most, limit / std::abs(cell.first[i]));
  }
  return 2 * most * cell.length;
}

// The largest x from which `exit` or less can be reached.
double TimeBound::entry_for(const Cell& cell, double exit) const {
  if (cell.line) return std::min(cell.entry_cap, exit + line_reach(cell));
  const auto possible = [&](double x) {
    const Range next = next_of(cell, x);
    return next.low <= next.high && next.low <= exit;
  };
  if (possible(cell.entry_cap)) return cell.entry_cap;
  double low = 0;
  double high = cell.entry_cap;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (possible(middle) ? low : high) = middle;
  }
  return low;
}

double TimeBound::exit_for(const Cell& cell, double entry, double most) const {
  if (cell.line) return std::min(most, entry + line_reach(cell));
  return std::max(std::min(most, next_of(cell, entry).high), 0.0);
}

// `last` is the largest x at the end of the window.
void TimeBound::plan_backwards(double last) {
  for (std::size_t i = cells_.size(); i-- > 0;) {
    Cell& cell = cells_[i];
    cell.controllable = entry_for(cell, std::min(last, cell.exit_cap));
    last = cell.controllable / cell.entry_scale;
  }
}

double TimeBound::time_of_line(const Cell& cell, double entry, double exit, double reach) {
  const double acceleration = reach / (2 * cell.length);
  // Both ends are below it, except for rounding.
  const double top = std::max({entry, exit, std::min(cell.exit_cap, (entry + exit + reach) / 2)});
  const double ramps = (2 * top - entry - exit) / (2 * acceleration);
  const double ramp_time = (2 * std::sqrt(top) - std::sqrt(entry) - std::sqrt(exit)) / acceleration;
  return ramp_time + std::max(cell.length - ramps, 0.0) / std::sqrt(top);
}

// Adds the time of the first `cells` cells, which are played.
void TimeBound::settle(std::size_t cells) {
  const bool all = cells == cells_.size();
  if (cells_.empty()) return;
  plan_backwards(all ? 0 : cells_.back().exit_cap);
  for (std::size_t i = 0; i < cells; ++i) {
    const Cell& cell = cells_[i];
    x_ = std::min(x_ * cell.entry_scale, cell.controllable);
    const double next = i + 1 < cells_.size() ? cells_[i + 1].controllable / cells_[i + 1].entry_scale : 0;
    const double exit = exit_for(cell, x_, std::min(next, cell.exit_cap));
    if (cell.line) {
      time_ += time_of_line(cell, x_, exit, line_reach(cell));
    } else {
      time_ += 2 * cell.length / (std::sqrt(x_) + std::sqrt(exit));
    }
    x_ = exit;
  }
  cells_.erase(cells_.begin(), cells_.begin() + static_cast<std::ptrdiff_t>(cells));
}

void TimeBound::end_stretch() {
  settle(cells_.size());
  joint_.reset();
  x_ = 0;
}

}  // namespace passo::proof
