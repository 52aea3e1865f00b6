#include "slowed_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "phase_pair.hpp"

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
  for (const Phase& phase : move) {
    if (!add(phase, segment)) return false;
  }
  const PathState planned = PathState::behind(move, segment);
  pieces_.back().ends_segment = planned.segment > segment;
  state_.segment = planned.segment;
  state_.s = planned.s;
  return true;
}

// The phase's way in two phases, as a cell is played.
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
  const NodeState from{.speed = state_.speed, .acceleration = state_.acceleration};
  const NodeState to{
      .speed = factor() * speed,
      .acceleration = factor() * factor() * planned.acceleration_at(planned.duration).value() - lacking_ * speed};
  const double way = planned.position_at(planned.duration).value() - planned.start.value();
  const PhasePair pair = PhasePair::over(way, from, to);
  if (!(pair.half > 0)) return false;
  PhaseChain chain{.at = planned.start.value(), .speed = from.speed, .acceleration = from.acceleration};
  for (const double jerk : {pair.first, pair.second}) {
    if (const auto phase = chain.next(pair.half, jerk)) pieces_.push_back({.segment = segment, .phase = *phase});
  }
  state_.speed = to.speed;
  state_.acceleration = to.acceleration;
  duration_ += 2 * pair.half;
  return !pieces_.empty();
}

}  // namespace passo
