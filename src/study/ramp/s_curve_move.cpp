#include "passo/ramp/s_curve_move.hpp"

#include <algorithm>
#include <cmath>

#include "jerk_ramp.hpp"

namespace passo {

struct SCurveMove::State {
  JerkLimits limits;
  double clock = 0;       // ticks a second
  double step_angle = 0;  // radians

  JerkRamp profile;
  std::int64_t leg_end = 0;  // where the leg comes to rest
  std::int64_t left = 0;     // steps to leg_end
  std::int64_t target = 0;
  bool up = true;

  // Times since the motor last stood still: of the profile's start, and of the last step.
  double start_time = 0;
  double time = 0;
  std::int64_t ticks = 0;
  double real_interval = 0;

  double way_done() const { return profile.way() - static_cast<double>(left); }
  std::int64_t position() const { return up ? leg_end - left : leg_end + left; }
  // The state at the last step. At both ends of a leg the motor stands still.
  JerkState now() const { return left == 0 || time == 0 ? JerkState{} : profile.state_at(way_done()); }

  void begin_leg();
  void go_on(std::int64_t steps);
};

void SCurveMove::State::begin_leg() {
  up = target > leg_end;
  left = std::abs(target - leg_end);
  leg_end = target;
  profile = JerkRamp::from_rest(static_cast<double>(left), limits);
  start_time = 0;
  time = 0;
  ticks = 0;
}

// Plans from the state at the last step to rest in `steps`. The clock runs on.
void SCurveMove::State::go_on(std::int64_t steps) {
  if (steps == left) return;
  profile = JerkRamp(now(), static_cast<double>(steps), limits);
  start_time = time;
  leg_end = up ? position() + steps : position() - steps;
  left = steps;
}

SCurveMove::SCurveMove(const SCurveLimits& limits) : state_(std::make_unique<State>()) {
  const double angle = step_angle(limits.setup.steps_per_turn).value;
  state_->limits = {.speed = limits.rate.value(),
                    .acceleration = limits.setup.acceleration.value / angle,
                    .jerk = limits.jerk.value / angle,
                    .end_speed = std::min(limits.start.value(), limits.rate.value())};
  state_->clock = limits.setup.clock.value();
  state_->step_angle = angle;
}
SCurveMove::~SCurveMove() = default;
SCurveMove::SCurveMove(SCurveMove&&) noexcept = default;
SCurveMove& SCurveMove::operator=(SCurveMove&&) noexcept = default;

bool SCurveMove::done() const {
  return state_->left == 0 && state_->leg_end == state_->target;
}

Ticks SCurveMove::next() {
  State& state = *state_;
  if (state.left == 0) state.begin_leg();
  --state.left;
  const double time = state.start_time + state.profile.time_at(state.way_done());
  const std::int64_t ticks = std::llround(time * state.clock);
  const Ticks interval{ticks - state.ticks};
  state.real_interval = (time - state.time) * state.clock;
  state.time = time;
  state.ticks = ticks;
  return interval;
}

double SCurveMove::real_interval() const {
  return state_->real_interval;
}
bool SCurveMove::up() const {
  return state_->up;
}
Steps SCurveMove::position() const {
  return {state_->position()};
}
Hertz SCurveMove::rate() const {
  return Hertz(state_->now().speed);
}
RadiansPerSecond2 SCurveMove::acceleration() const {
  return {state_->now().acceleration * state_->step_angle};
}

void SCurveMove::move_to(Steps target) {
  State& state = *state_;
  state.target = target.count;
  if (state.left == 0) return;
  const std::int64_t here = state.position();
  const std::int64_t ahead = state.up ? target.count - here : here - target.count;
  // The way to rest, in whole steps. Only rounding can make it longer than the present leg.
  const double shortest = JerkRamp::shortest(state.now(), state.limits);
  const auto least = std::min(static_cast<std::int64_t>(std::ceil(shortest)), state.left);
  state.go_on(std::max(ahead, std::max<std::int64_t>(least, 1)));
}

void SCurveMove::stop() {
  move_to(position());
  state_->target = state_->leg_end;
}

}  // namespace passo
