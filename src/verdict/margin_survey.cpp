#include "passo/verdict/margin_survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "swing.hpp"

namespace passo {
namespace {

constexpr double radians_between_looks = 0.15;
constexpr int most_looks = 64;
constexpr double nothing = 1e-9;
// A motor that stays within a fifth of its speed for so long has time to begin to swing: some periods of its ringing.
constexpr double band_of_speed = 0.2;
constexpr double time_to_swing = 0.03;  // s

// In how many pieces a phase is looked at. On a line without jerk torque and speed have their extremes at the ends;
// between them the speed passes places where the motor swings.
int looks_in(const Curve& curve, const Phase& phase) {
  const double change = std::abs(phase.velocity_at(phase.duration).value() - phase.velocity.value());
  const double fastest = std::max(phase.velocity_at(phase.duration).value(), phase.velocity.value());
  double looks = change > band_of_speed * fastest ? 6 : 1;
  if (phase.jerk.value() != 0) looks = 8;
  if (curve.shape() != Curve::Shape::line) {
    const double way = (phase.position_at(phase.duration) - phase.start).value();
    looks = std::max(looks, 2 + way * curve.curvature() / radians_between_looks);
  }
  return static_cast<int>(std::min<double>(looks, most_looks));
}

bool is_worse(const MarginSpot& a, const MarginSpot& b) {
  return std::tuple(a.verdict, a.load()) > std::tuple(b.verdict, b.load());
}

}  // namespace

// A moment of one axis.
struct MarginSurvey::Moment {
  Moment(const SurveyedMotor& motor, const PlannedMove& move, const Phase& phase, Seconds t, Seconds now)
      : line(move.segment.source.line),
        rapid(move.segment.rapid),
        time(now),
        path_speed(std::max(phase.velocity_at(t).value(), 0.0)) {
    const Mm s = phase.position_at(t);
    const double slope = move.segment.curve.tangent(s)[motor.axis];
    const double bend =
        move.segment.curve.shape() == Curve::Shape::line ? 0 : move.segment.curve.second_derivative(s)[motor.axis];
    speed = slope * path_speed;
    bending = bend * path_speed * path_speed;
    acceleration = slope * phase.acceleration_at(t).value() + bending;
    shaft = {std::abs(speed) * motor.radians_per_unit};
    torque = torque_for(motor, acceleration);
  }

  // The torque towards the high end, N·m, at this speed.
  double torque_for(const SurveyedMotor& motor, double axis_acceleration) const {
    double friction = 0;
    if (std::abs(speed) > nothing) {
      friction = std::copysign(motor.load.friction_at(shaft).value, speed);
    } else if (std::abs(axis_acceleration) > nothing) {
      friction = std::copysign(motor.load.friction.value, axis_acceleration);
    }
    return motor.inertia * axis_acceleration * motor.radians_per_unit + friction + motor.weight;
  }
  // Whether the axis stays at about this speed long enough to begin to swing.
  bool is_steady() const {
    return std::abs(speed) > nothing && std::abs(acceleration) * time_to_swing < band_of_speed * std::abs(speed);
  }

  std::uint32_t line;
  bool rapid;
  Seconds time;
  double path_speed;
  double speed = 0;
  double acceleration = 0;
  double bending = 0;
  RadiansPerSecond shaft = {};
  double torque = 0;
};

double MarginSpot::load() const {
  constexpr double most = 1e6;
  return needed.value < most * there.low.value ? needed.value / there.low.value : most;
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::safe: return "safe";
    case Verdict::doubtful: return "doubtful";
    case Verdict::lost: break;
  }
  return "lost";
}

MarginSurvey::MarginSurvey(std::vector<SurveyedMotor> motors, double reserve)
    : motors_(std::move(motors)), share_(1 - reserve), states_(motors_.size()) {
  rest();
}

void MarginSurvey::watch(const MotionItem& item) {
  if (const auto* move = std::get_if<PlannedMove>(&item)) {
    watch_move(*move);
    return;
  }
  rest();
  now_ += std::get<Action>(item).dwell;
}

void MarginSurvey::rest() {
  for (std::size_t m = 0; m < motors_.size(); ++m) {
    stand(m);
  }
}

// The axis rests, or has nothing to do in the motion of the others.
void MarginSurvey::stand(std::size_t motor) {
  constexpr double for_ever = 1e9;
  states_[motor].torque = motors_[motor].weight;
  states_[motor].acceleration = 0;
  states_[motor].lasted = for_ever;
  states_[motor].behind = states_[motor].behind_rate = 0;
}

void MarginSurvey::watch_move(const PlannedMove& move) {
  if (move.segment.source.line != line_) end_line();
  line_ = move.segment.source.line;
  last_load_ = 0;
  for (const Phase& phase : move) {
    for (std::size_t m = 0; m < motors_.size(); ++m) watch_phase(move, phase, m);
    now_ += phase.duration;
  }
}

void MarginSurvey::watch_phase(const PlannedMove& move, const Phase& phase, std::size_t motor) {
  if (move.segment.curve.shape() == Curve::Shape::line && !move.segment.curve.moves(motors_[motor].axis)) {
    stand(motor);
    return;
  }
  const int looks = looks_in(move.segment.curve, phase);
  for (int i = 0; i <= looks; ++i) {
    const Seconds t = phase.duration * (static_cast<double>(i) / looks);
    const Moment moment(motors_[motor], move, phase, t, now_ + t);
    if (i == 0) judge_jump(motor, moment, phase, states_[motor]);
    states_[motor].torque = moment.torque;
    states_[motor].acceleration = moment.acceleration;
    judge(motor, moment);
    if (i > 0 && falls_behind(motor, moment, phase.duration.value() / looks)) {
      MarginSpot spot = spot_at(motors_[motor], moment);
      spot.verdict = Verdict::lost;
      note(motor, spot);
    }
  }
  states_[motor].lasted += phase.duration.value();
}

void MarginSurvey::judge(std::size_t motor, const Moment& moment) {
  const TorqueBand& band = motors_[motor].band;
  MarginSpot spot = spot_at(motors_[motor], moment);
  const bool may_swing = motors_[motor].coarse_steps ? moment.shaft.value > 0 : moment.is_steady();
  if (may_swing && band.swings_at(moment.shaft) && spot.needed.value <= share_ * spot.there.low.value) {
    spot.there.low = band.while_steady(moment.shaft);
    spot.want = Want::calm;
  }
  spot.verdict = spot.needed.value > share_ * spot.there.low.value ? Verdict::doubtful : Verdict::safe;
  if (spot.verdict == Verdict::safe) spot.want = Want::torque;
  note(motor, spot);
}

void MarginSurvey::judge_jump(std::size_t motor, const Moment& moment, const Phase& phase, const State& before) {
  const TorqueRange there = motors_[motor].band.of_curve(moment.shaft);
  constexpr double notable = 0.05;
  if (std::abs(moment.torque - before.torque) < notable * there.low.value) return;
  const double swings = torque_to_catch(before.torque, moment.torque);
  MarginSpot spot = spot_at(motors_[motor], moment);
  spot.needed = {swings};
  spot.of_motion = {std::max(std::abs(before.torque), std::abs(moment.torque))};
  spot.acceleration = MmPerSecond2(std::max(std::abs(before.acceleration), std::abs(moment.acceleration)));
  if (swings > share_ * there.low.value) {
    spot.verdict = Verdict::doubtful;
    spot.want = Want::jump;
  }
  // The rotor's own losses may still catch a swing that is only just too large.
  constexpr double beyond_losses = 1.1;
  const double stiffness = motors_[motor].band.rotor().teeth() * there.high.value;
  const double period = 2 * std::numbers::pi * std::sqrt(motors_[motor].inertia / stiffness);
  const bool settled = std::exchange(states_[motor].lasted, 0) > period;
  const bool lasts = phase.jerk.value() == 0 && phase.duration.value() > period;
  if (settled && lasts && swings > beyond_losses * there.high.value) spot.verdict = Verdict::lost;
  note(motor, spot);
}

// What exceeds the high end slows the rotor against the field; what is left below it brings the rotor back.
bool MarginSurvey::falls_behind(std::size_t motor, const Moment& moment, double time) {
  State& state = states_[motor];
  const SurveyedMotor& own = motors_[motor];
  const double excess = (std::abs(moment.torque) - own.band.of_curve(moment.shaft).high.value) / own.inertia;
  if (excess <= 0 && state.behind_rate <= 0) return false;
  state.behind += time * (state.behind_rate + excess * time / 2);
  state.behind_rate += excess * time;
  if (state.behind_rate <= 0) state.behind = state.behind_rate = 0;
  return state.behind * own.band.rotor().steps_per_revolution > 2 * std::numbers::pi;
}

void MarginSurvey::note(std::size_t motor, const MarginSpot& spot) {
  last_load_ = std::max(last_load_, spot.load());
  const std::optional<MmPerSecond2> cure = safe_acceleration(motors_[motor], spot);
  std::optional<MarginSpot>& worst = states_[motor].worst_of_line;
  const std::optional<MmPerSecond2> other = worst ? worst->safe_acceleration : std::nullopt;
  if (!worst || is_worse(spot, *worst)) worst = spot;
  // The cure of a line is one for all its moments.
  worst->safe_acceleration = cure && other ? std::min(*cure, *other) : (cure ? cure : other);
}

MarginSpot MarginSurvey::spot_at(const SurveyedMotor& own, const Moment& moment) {
  MarginSpot spot{.axis = own.axis, .line = moment.line, .time = moment.time, .rapid = moment.rapid};
  spot.needed = {std::abs(moment.torque)};
  spot.of_motion = spot.needed;
  spot.there = own.band.of_curve(moment.shaft);
  spot.rate = own.band.rate_at(moment.shaft);
  spot.speed = MmPerSecond(std::abs(moment.speed));
  spot.path_speed = MmPerSecond(moment.path_speed);
  spot.acceleration = MmPerSecond2(std::abs(moment.acceleration));
  spot.bending = MmPerSecond2(std::abs(moment.bending));
  return spot;
}

// The greatest acceleration with which the moment would be safe at its speed.
std::optional<MmPerSecond2> MarginSurvey::safe_acceleration(const SurveyedMotor& own, const MarginSpot& spot) const {
  if (spot.verdict == Verdict::safe || !(spot.of_motion.value > 0)) return {};
  const double swing = spot.needed.value / spot.of_motion.value;
  const double for_each = own.inertia * own.radians_per_unit;  // N·m for mm/s²
  const double rest = spot.of_motion.value - for_each * spot.acceleration.value();
  const double acceleration = (share_ * spot.there.low.value / swing - rest) / for_each;
  if (acceleration > 0 && acceleration < spot.acceleration.value()) return MmPerSecond2(acceleration);
  return {};
}

// The greatest speed with which the moment would be safe at its acceleration.
void MarginSurvey::find_safe_speed(MarginSpot& spot) const {
  if (spot.verdict == Verdict::safe) return;
  const auto own = std::ranges::find(motors_, spot.axis, &SurveyedMotor::axis);
  const double swing = spot.of_motion.value > 0 ? spot.needed.value / spot.of_motion.value : 1;
  const double for_each = own->inertia * own->radians_per_unit;
  const double shaft = spot.speed.value() * own->radians_per_unit;
  constexpr int parts = 50;
  for (int i = parts - 1; i > 0 && shaft > 0; --i) {
    const double part = static_cast<double>(i) / parts;
    const double turning = spot.bending.value() * (1 - part * part);
    const double needed = swing * (spot.of_motion.value - for_each * std::min(turning, spot.acceleration.value()));
    const NewtonMetres there =
        spot.want == Want::calm ? own->band.while_steady({part * shaft}) : own->band.of_curve({part * shaft}).low;
    if (needed > share_ * there.value) continue;
    spot.safe_path_speed = part * spot.path_speed;
    break;
  }
}

MarginVerdict MarginSurvey::verdict() {
  end_line();
  MarginVerdict whole;
  for (std::size_t m = 0; m < motors_.size(); ++m) {
    std::optional<MarginSpot> worst = states_[m].worst;
    if (worst) {
      find_safe_speed(*worst);
      whole.verdict = std::max(whole.verdict, worst->verdict);
    }
    whole.axes.push_back({.axis = motors_[m].axis, .worst = worst});
  }
  whole.worst = worst_;
  for (MarginSpot& spot : whole.worst) find_safe_speed(spot);
  return whole;
}

void MarginSurvey::end_line() {
  for (State& state : states_) {
    if (!state.worst_of_line) continue;
    if (!state.worst || is_worse(*state.worst_of_line, *state.worst)) state.worst = state.worst_of_line;
    keep(*state.worst_of_line);
    state.worst_of_line.reset();
  }
}

void MarginSurvey::keep(const MarginSpot& spot) {
  const auto same = [&](const MarginSpot& other) { return other.line == spot.line && other.axis == spot.axis; };
  if (const auto found = std::ranges::find_if(worst_, same); found != worst_.end()) {
    if (!is_worse(spot, *found)) return;
    worst_.erase(found);
  }
  worst_.insert(std::ranges::find_if(worst_, [&](const MarginSpot& other) { return is_worse(spot, other); }), spot);
  if (worst_.size() > most_worst) worst_.pop_back();
}

}  // namespace passo
