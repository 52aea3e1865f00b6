#include "slowed_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passo {
namespace {

// e above: a third of what the plan leaves of a limit (planned_share), since jerks change with the third power.
constexpr double first = 2e-4;
// Of g: phases of constant jerk follow the law nearly.
constexpr double carefully = 0.7;

}  // namespace

SlowedPlan::SlowedPlan(const std::vector<LimitedAxis>& axes, const PathState& state)
    : axes_(axes), state_(state), lacks_(first) {}

double SlowedPlan::factor() const {
  return 1 + first - lacks_;
}

// g: of each axis, g² v + 3 g a <= 3 j and g v <= 2 a.
double SlowedPlan::rate(double speed) const {
  double least = std::numeric_limits<double>::infinity();
  for (const LimitedAxis& axis : axes_) {
    const double a = axis.acceleration;
    least = std::min(least, 2 * a / speed);
    if (!std::isfinite(axis.jerk)) continue;
    const double of_force = std::isfinite(a) ? 3 * a : 0;
    least = std::min(least, 6 * axis.jerk / (of_force + std::sqrt(of_force * of_force + 12 * axis.jerk * speed)));
  }
  return carefully * least;
}

bool SlowedPlan::add(const PlannedMove& move, std::uint64_t segment) {
  const double end = move.segment.curve.length().value();
  for (const Phase& phase : move) {
    if (!add(phase, segment)) return false;
  }
  const bool ends = move.to.value() >= end;
  pieces_.back().ends_segment = ends;
  state_.segment = ends ? segment + 1 : segment;
  state_.s = ends ? 0 : move.to.value();
  return true;
}

// The phase's way in two phases of equal time, as a cell is played (JerkProfile::pair_of).
bool SlowedPlan::add(const Phase& planned, std::uint64_t segment) {
  const double time = planned.duration.value();
  const double speed = planned.velocity_at(planned.duration).value();
  if (!(speed > 0)) return false;
  const double g = rate(std::max(speed, planned.velocity.value()));
  const double grown = std::exp(g * time / factor());
  const double rising = (lacks_ + lacking_ / g) / 2 * grown;
  const double falling = (lacks_ - lacking_ / g) / 2 / grown;
  lacks_ = rising + falling;
  lacking_ = g * (rising - falling);
  if (!(factor() > 0)) return false;
  const double to_speed = factor() * speed;
  const double to_acceleration =
      factor() * factor() * planned.acceleration_at(planned.duration).value() - lacking_ * speed;
  const double way = planned.position_at(planned.duration).value() - planned.start.value();
  const double sum = state_.speed + to_speed;
  const double change = to_acceleration - state_.acceleration;
  const double root = sum * sum - 4.0 / 3 * change * way;
  if (!(root > 0)) return false;
  const double half = 2 * way / (sum + std::sqrt(root));
  const double jerk = ((to_speed - state_.speed) / half - 2 * state_.acceleration - change / 2) / half;
  PhaseChain chain{.at = planned.start.value(), .speed = state_.speed, .acceleration = state_.acceleration};
  for (const double one : {jerk, change / half - jerk}) {
    if (const auto phase = chain.next(half, one)) pieces_.push_back({.segment = segment, .phase = *phase});
  }
  state_.speed = to_speed;
  state_.acceleration = to_acceleration;
  duration_ += 2 * half;
  return !pieces_.empty();
}

}  // namespace passo
