#include "passo/verdict/margin_survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "swing.hpp"

#include "passo/stepgen/event_leader.hpp"

namespace passo {
namespace {

constexpr double radians_between_looks = 0.15;
constexpr double nothing = 1e-9;
constexpr double band_of_speed = 0.2;
constexpr Seconds time_to_swing{0.1};
constexpr Seconds after_the_end{0.5};

// In how many pieces a phase is looked at. On a line without jerk torque and speed have their extremes at the ends;
// between them the speed passes places where the motor swings.
int looks_in(const Curve& curve, const Phase& phase, int most) {
  const double change = std::abs(phase.velocity_at(phase.duration).value() - phase.velocity.value());
  const double fastest = std::max(phase.velocity_at(phase.duration).value(), phase.velocity.value());
  double looks = change > band_of_speed * fastest ? 6 : 1;
  if (phase.jerk.value() != 0) looks = 8;
  if (curve.shape() != Curve::Shape::line) {
    const double way = (phase.position_at(phase.duration) - phase.start).value();
    looks = std::max(looks, 2 + way * curve.curvature() / radians_between_looks);
  }
  return static_cast<int>(std::min<double>(looks, most));
}

bool is_worse(const MarginSpot& a, const MarginSpot& b) {
  return std::tuple(a.verdict, a.load()) > std::tuple(b.verdict, b.load());
}

}  // namespace

MarginSurvey::Look::Look(const PlannedMove& move, const Phase& phase, Seconds t, Seconds now)
    : time(now), speed(std::max(phase.velocity_at(t).value(), 0.0)), acceleration(phase.acceleration_at(t).value()) {
  const Curve& curve = move.segment.curve;
  const Mm s = phase.position_at(t);
  place = curve.at(s);
  slope = curve.tangent(s);
  if (curve.shape() != Curve::Shape::line) bend = curve.second_derivative(s);
}

// A moment of one axis.
struct MarginSurvey::Moment {
  Moment(const SurveyedMotor& motor, const PlannedMove& move, const Look& look, double newtons_per_speed)
      : line(move.segment.source.line), rapid(move.segment.rapid), time(look.time), path_speed(look.speed) {
    place = look.place[motor.axis];
    speed = look.slope[motor.axis] * look.speed;
    bending = look.bend[motor.axis] * look.speed * look.speed;
    acceleration = look.slope[motor.axis] * look.acceleration + bending;
    shaft = {std::abs(speed) * motor.radians_per_unit};
    if (!rapid && !is_rotary(motor.axis) && std::abs(speed) > nothing) {
      constexpr double per_metre = 1000;  // mm
      cut = newtons_per_speed * path_speed / (motor.radians_per_unit * per_metre);
    }
    torque = torque_for(motor, acceleration);
  }

  // The torque towards the high end, N·m, at this speed.
  double torque_for(const SurveyedMotor& motor, double axis_acceleration) const {
    double friction = 0;
    if (std::abs(speed) > nothing) {
      friction = std::copysign(motor.load.friction_at(shaft).value + cut, speed);
    } else if (std::abs(axis_acceleration) > nothing) {
      friction = std::copysign(motor.load.friction.value, axis_acceleration);
    }
    return motor.inertia * axis_acceleration * motor.radians_per_unit + friction + motor.weight;
  }

  std::uint32_t line;
  bool rapid;
  Seconds time;
  double path_speed;
  double place = 0;
  double speed = 0;
  double acceleration = 0;
  double bending = 0;
  RadiansPerSecond shaft = {};
  double cut = 0;  // N·m
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

MarginSurvey::MarginSurvey(std::vector<SurveyedMotor> motors, const StepGrid& grid, double reserve)
    : motors_(std::move(motors)), grid_(grid), share_(1 - reserve), states_(motors_.size()) {
  for (const SurveyedMotor& motor : motors_) {
    trials_.emplace_back(motor.setup, motor.tolerance, motor.radians_per_unit, motor.fastest);
  }
  rest(Seconds(0));
}

void MarginSurvey::watch(const MotionItem& item) {
  if (motors_.empty()) return;
  if (const auto* move = std::get_if<PlannedMove>(&item)) {
    watch_move(*move);
    return;
  }
  const Seconds dwell = std::get<Action>(item).dwell;
  rest(dwell);
  now_ += dwell;
}

void MarginSurvey::rest(Seconds time) {
  for (std::size_t m = 0; m < motors_.size(); ++m) stand(m, time);
}

// The axis rests, or has nothing to do in the motion of the others.
void MarginSurvey::stand(std::size_t motor, Seconds time) {
  State& state = states_[motor];
  state.torque = motors_[motor].weight;
  state.acceleration = 0;
  state.lacks_since.reset();
  const TrialFinding finding = trials_[motor].stand(time);
  if (state.hardest) judge(motor, *state.hardest, finding);
}

void MarginSurvey::watch_move(const PlannedMove& move) {
  if (move.segment.source.line != line_) end_line();
  line_ = move.segment.source.line;
  last_load_ = 0;
  for (const Phase& phase : move) {
    watch_phase(move, phase);
    now_ += phase.duration;
  }
}

void MarginSurvey::watch_phase(const PlannedMove& move, const Phase& phase) {
  const Curve& curve = move.segment.curve;
  const int count = looks_in(curve, phase, most_looks);
  looks_.clear();
  for (int i = 0; i <= count; ++i) {
    const Seconds t = phase.duration * (static_cast<double>(i) / count);
    looks_.emplace_back(move, phase, t, now_ + t);
    if (i == 0) continue;
    find_leader(looks_[looks_.size() - 2], looks_.back());
    looks_.back().leader = leader_;
  }
  for (std::size_t m = 0; m < motors_.size(); ++m) {
    if (curve.shape() == Curve::Shape::line && !curve.moves(motors_[m].axis)) {
      stand(m, phase.duration);
    } else {
      watch_motor(move, m);
    }
  }
}

void MarginSurvey::watch_motor(const PlannedMove& move, std::size_t motor) {
  const SurveyedMotor& own = motors_[motor];
  Moment from(own, move, looks_[0], cut_);
  MarginSpot worst = spot_at(motor, from);
  update_lack(motor, worst);
  add_jump(motor, from, worst);
  for (std::size_t i = 1; i < looks_.size(); ++i) {
    const Moment to(own, move, looks_[i], cut_);
    const MarginSpot spot = spot_at(motor, to);
    update_lack(motor, spot);
    if (is_worse(spot, worst)) worst = spot;
    AxisPiece piece{.duration = to.time - from.time,
                    .from = from.place,
                    .to = to.place,
                    .speed_from = from.speed,
                    .speed_to = to.speed,
                    .load = worst.load(),
                    .resistance = {(from.cut + to.cut) / 2}};
    if (const Leader& leader = looks_[i].leader; leader.axis && leader.axis != own.axis) {
      const double lines = grid_.steps_per_unit[*leader.axis] * leader.division;
      piece.grid_from = looks_[i - 1].place[*leader.axis] * lines + leader.division / 2;
      piece.grid_to = looks_[i].place[*leader.axis] * lines + leader.division / 2;
    }
    judge(motor, worst, trials_[motor].play(piece));
    worst = spot;
    from = to;
  }
  states_[motor].torque = from.torque;
  states_[motor].acceleration = from.acceleration;
}

// By the rules of the step generator, at the two looks.
void MarginSurvey::find_leader(const Look& from, const Look& to) {
  std::optional<Axis> axis;
  double most = 0;
  const auto steps_of = [&](Axis one) { return std::abs(to.place[one] - from.place[one]) * grid_.steps_per_unit[one]; };
  for (const Axis one : all_axes) {
    if (steps_of(one) <= most * event_leader::takeover) continue;
    most = steps_of(one);
    axis = one;
  }
  if (!axis) {
    leader_ = {};
    return;
  }
  const double slope = std::max(std::abs(from.slope[*axis]), std::abs(to.slope[*axis])) * grid_.steps_per_unit[*axis];
  const double rate =
      std::sqrt(event_leader::rate_squared(slope, std::max(from.speed, to.speed), from.acceleration, 1));
  const double slow = grid_.slow_rate.value();
  const double events = rate * leader_.division;
  const bool fits = events > event_leader::rate_before_finer * slow &&
                    (events <= event_leader::rate_before_coarser * slow || leader_.division == 1);
  if (leader_.axis == axis && fits) return;
  leader_ = {.axis = axis};
  while (rate * leader_.division < slow && leader_.division < event_leader::finest_division) leader_.division *= 2;
}

// The verdict is that of the trial. The formula says what the cause was.
void MarginSurvey::judge(std::size_t motor, MarginSpot spot, const TrialFinding& finding) {
  std::optional<MarginSpot>& hardest = states_[motor].hardest;
  if (!hardest || spot.load() >= hardest->load() || spot.time - hardest->time > time_to_swing) hardest = spot;
  if (finding.judged && finding.lost == 0 && finding.most_swing < safe_swing) {
    spot.verdict = Verdict::safe;
    spot.want = LossCause::torque;
  } else if (finding.judged) {
    spot = *hardest;
    if (!is_lack(motor, spot) && spot.verdict == Verdict::safe) spot.want = LossCause::calm;
    spot.verdict = finding.lost > 0 && finding.usual_out ? Verdict::lost : Verdict::doubtful;
  } else if (spot.want == LossCause::jump) {
    static_cast<void>(is_lack(motor, spot));
  }
  record(motor, spot);
}

void MarginSurvey::record(std::size_t motor, const MarginSpot& spot) {
  last_load_ = std::max(last_load_, spot.load());
  if (spot.line != line_) {  // its line has ended
    keep(spot);
    if (!states_[motor].worst || is_worse(spot, *states_[motor].worst)) states_[motor].worst = spot;
    return;
  }
  const std::optional<MmPerSecond2> cure = safe_acceleration(motors_[motor], spot);
  std::optional<MarginSpot>& worst = states_[motor].worst_of_line;
  const std::optional<MmPerSecond2> other = worst ? worst->safe_acceleration : std::nullopt;
  if (!worst || is_worse(spot, *worst)) worst = spot;
  // The cure of a line is one for all its moments.
  worst->safe_acceleration = cure && other ? std::min(*cure, *other) : (cure ? cure : other);
}

// By the formula.
MarginSpot MarginSurvey::spot_at(std::size_t motor, const Moment& moment) const {
  const SurveyedMotor& own = motors_[motor];
  MarginSpot spot{.axis = own.axis, .line = moment.line, .time = moment.time, .rapid = moment.rapid};
  spot.needed = {std::abs(moment.torque)};
  spot.of_motion = spot.needed;
  spot.of_cut = {moment.cut};
  spot.there = own.band.of_curve(moment.shaft);
  spot.rate = own.band.rate_at(moment.shaft);
  spot.speed = MmPerSecond(std::abs(moment.speed));
  spot.path_speed = MmPerSecond(moment.path_speed);
  spot.acceleration = MmPerSecond2(std::abs(moment.acceleration));
  spot.bending = MmPerSecond2(std::abs(moment.bending));
  spot.verdict = spot.needed.value > share_ * spot.there.low.value ? Verdict::doubtful : Verdict::safe;
  return spot;
}

// Adds the swing after the jump from the last phase to the first moment of a phase.
void MarginSurvey::add_jump(std::size_t motor, const Moment& moment, MarginSpot& spot) const {
  const State& before = states_[motor];
  constexpr double notable = 0.05;
  if (std::abs(moment.torque - before.torque) < notable * spot.there.low.value) return;
  spot.needed = {torque_to_catch(before.torque, moment.torque)};
  spot.of_motion = {std::max(std::abs(before.torque), std::abs(moment.torque))};
  spot.acceleration = MmPerSecond2(std::max(std::abs(before.acceleration), std::abs(moment.acceleration)));
  if (spot.needed.value > share_ * spot.there.low.value) {
    spot.verdict = Verdict::doubtful;
    spot.want = LossCause::jump;
  }
}

// Follows how long the motion itself needs more than there surely is. Within a quarter of its own period a rotor cannot
// tell an acceleration from a jump of its speed.
void MarginSurvey::update_lack(std::size_t motor, const MarginSpot& spot) {
  State& state = states_[motor];
  if (spot.of_motion.value <= spot.there.low.value) {
    state.lacks_since.reset();
    return;
  }
  if (!state.lacks_since) state.lacks_since = spot.time;
  const SurveyedMotor& own = motors_[motor];
  constexpr double steps_a_period = 4;
  const double stiffness =
      own.setup.motor.rotor.steps_per_revolution / steps_a_period * own.band.of_curve({0}).low.value;
  const Seconds quarter(std::numbers::pi / 2 * std::sqrt(own.inertia / stiffness));
  if (spot.time - *state.lacks_since >= quarter) state.lack = spot;
}

// Whether the torque itself was short just before. Then that is the cause, and the spot tells of it. The cure is still
// that of the spot, since a cure has to care for the swing too.
bool MarginSurvey::is_lack(std::size_t motor, MarginSpot& spot) const {
  const std::optional<MarginSpot>& lack = states_[motor].lack;
  if (!lack || spot.time - lack->time > time_to_swing) return false;
  spot.want = LossCause::torque;
  spot.lack =
      TorqueShortage{.needed = lack->of_motion, .of_cut = lack->of_cut, .there = lack->there, .rate = lack->rate};
  return true;
}

// The greatest acceleration with which the moment would be safe at its speed.
std::optional<MmPerSecond2> MarginSurvey::safe_acceleration(const SurveyedMotor& own, const MarginSpot& spot) const {
  if (spot.verdict == Verdict::safe || spot.want == LossCause::calm || !(spot.of_motion.value > 0)) return {};
  const double swing = spot.needed.value / spot.of_motion.value;
  const double for_each = own.inertia * own.radians_per_unit;  // N·m for mm/s²
  const double rest = spot.of_motion.value - for_each * spot.acceleration.value();
  const double acceleration = (share_ * spot.there.low.value / swing - rest) / for_each;
  if (acceleration > 0 && acceleration < spot.acceleration.value()) return MmPerSecond2(acceleration);
  return {};
}

// The greatest speed with which the moment would be safe at its acceleration.
void MarginSurvey::find_safe_speed(MarginSpot& spot) {
  if (spot.verdict == Verdict::safe) return;
  const auto own = std::ranges::find(motors_, spot.axis, &SurveyedMotor::axis);
  if (spot.want == LossCause::calm && !own->band.tried()) own->band.try_steady(own->fastest);
  const double swing = spot.of_motion.value > 0 ? spot.needed.value / spot.of_motion.value : 1;
  const double for_each = own->inertia * own->radians_per_unit;
  const double shaft = spot.speed.value() * own->radians_per_unit;
  constexpr int parts = 50;
  for (int i = parts - 1; i > 0 && shaft > 0; --i) {
    const double part = static_cast<double>(i) / parts;
    const double turning = spot.bending.value() * (1 - part * part);
    const double needed = swing * (spot.of_motion.value - for_each * std::min(turning, spot.acceleration.value()) -
                                   spot.of_cut.value * (1 - part));
    const NewtonMetres there =
        spot.want == LossCause::calm ? own->band.while_steady({part * shaft}) : own->band.of_curve({part * shaft}).low;
    if (needed > share_ * there.value) continue;
    spot.safe_path_speed = part * spot.path_speed;
    break;
  }
}

// With its cure known, the spot tells what was short.
void MarginSurvey::show_lack(MarginSpot& spot) {
  if (!spot.lack) return;
  spot.needed = spot.of_motion = spot.lack->needed;
  spot.of_cut = spot.lack->of_cut;
  spot.there = spot.lack->there;
  spot.rate = spot.lack->rate;
}

MarginVerdict MarginSurvey::verdict() {
  rest(after_the_end);
  end_line();
  MarginVerdict whole;
  for (std::size_t m = 0; m < motors_.size(); ++m) {
    std::optional<MarginSpot> worst = states_[m].worst;
    if (worst) {
      // One motor here, another there.
      if (trials_[m].usual_lost()) worst->verdict = Verdict::lost;
      find_safe_speed(*worst);
      show_lack(*worst);
      whole.verdict = std::max(whole.verdict, worst->verdict);
    }
    whole.axes.push_back({.axis = motors_[m].axis, .worst = worst});
  }
  whole.worst = worst_;
  for (MarginSpot& spot : whole.worst) {
    find_safe_speed(spot);
    show_lack(spot);
  }
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
