#include "phase_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rounding.hpp"

namespace passo::proof {
namespace {

constexpr double turn_between_looks = 0.05;  // radians
constexpr double fewest_looks = 12;
constexpr double most_looks = 4096;

}  // namespace

PhasePeaks::PhasePeaks(MotionProof& proof, const ProofOptions& options)
    : proof_(proof), before_(proof.axes.size()), stopped_(proof.axes.size()) {
  for (const ProvenAxis& axis : options.axes) {
    limits_.emplace_back(axis);
    start_stop_.push_back(axis.start_stop.value());
    backlash_[axis.axis] = axis.backlash.value();
  }
}

PhasePeaks::Way PhasePeaks::way_at(const Phase& phase, double t) {
  const double v = phase.velocity.value();
  const double a = phase.acceleration.value();
  const double j = phase.jerk.value();
  return {.s = phase.start.value() + v * t + a * t * t / 2 + j * t * t * t / 6,
          .v = v + a * t + j * t * t / 2,
          .a = a + j * t,
          .j = j};
}

PhasePeaks::Motion PhasePeaks::motion_of(const Derivatives& q, const Way& way) {
  return {.velocity = q.first * way.v,
          .acceleration = q.second * way.v * way.v + q.first * way.a,
          .jerk = q.third * way.v * way.v * way.v + 3 * q.second * way.v * way.a + q.first * way.j};
}

void PhasePeaks::raise(Finding& finding, double value, double t) const {
  if (!(std::abs(value) > finding.value)) return;
  finding.value = std::abs(value);
  finding.time = now_ + Seconds(t);
  finding.line = line_;
}

// The share of its limit that an acceleration takes, expressed as mm/s² of the constant limit.
double PhasePeaks::severity(std::size_t i, const Motion& motion) const {
  const SpeedLimit& limit = limits_[i];
  const double value = std::abs(motion.acceleration);
  return limit.falls() ? value * limit.constant() / limit.at(motion.velocity) : value;
}

void PhasePeaks::raise_acceleration(std::size_t i, const Motion& motion, double t) {
  Finding& finding = proof_.axes[i].acceleration;
  if (!limits_[i].falls()) {
    raise(finding, motion.acceleration, t);
    return;
  }
  const double limit = limits_[i].at(motion.velocity);
  if (!(std::abs(motion.acceleration) > finding.multiple() * limit)) return;
  finding.limit = limit;
  finding.value = 0;
  raise(finding, motion.acceleration, t);
}

void PhasePeaks::see(std::size_t i, const Motion& motion, double t) {
  AxisProof& axis = proof_.axes[i];
  raise(axis.velocity, motion.velocity, t);
  raise_acceleration(i, motion, t);
  raise(axis.jerk, motion.jerk, t);
}

void PhasePeaks::watch(const PlannedMove& move) {
  if (!move.segment.curve.has_length() || move.phase_count == 0) return;
  ++proof_.moves;
  line_ = move.segment.source.line;
  downs_ = move.segment.downs;
  const ExactCurve curve(move.segment.curve);
  bool begins_segment = move.from() == Mm(0);
  for (const Phase& phase : move) {
    ++proof_.phases;
    join(curve, phase, std::exchange(begins_segment, false) || at_rest_);
    at_rest_ = false;
    measure(curve, phase);
    see_feed(move.segment, phase);
    const Way end = way_at(phase, phase.duration.value());
    for (std::size_t i = 0; i < before_.size(); ++i) before_[i] = motion_of(curve.at(proof_.axes[i].axis, end.s), end);
    place_ = motors_at(curve.place(end.s));
    now_ += phase.duration;
  }
  check_gap(distance(*place_, motors_at(curve.place(move.to.value()))));
}

// A motor that drives its axis in the negative direction is a backlash behind it.
Point PhasePeaks::motors_at(Point place) const {
  for (const Axis axis : all_axes) {
    if (downs_.has(axis)) place[axis] -= backlash_[axis];
  }
  return place;
}

// Compares the end of the last phase with the start of this one. `rests`: the machine may have rested between.
void PhasePeaks::join(const ExactCurve& curve, const Phase& phase, bool rests) {
  const Way start = way_at(phase, 0);
  if (place_) check_gap(distance(*place_, motors_at(curve.place(start.s))));
  rests = rests || stands();
  for (std::size_t i = 0; i < before_.size(); ++i) {
    meet(i, motion_of(curve.at(proof_.axes[i].axis, start.s), start), rests);
    stopped_[i] = 0;
  }
}

// Whether the machine stood at the end of the last phase. A hold rests so within a segment.
bool PhasePeaks::stands() const {
  for (std::size_t i = 0; i < before_.size(); ++i) {
    if (std::abs(before_[i].velocity) > velocity_rounding * proof_.axes[i].velocity.limit) return false;
  }
  return true;
}

void PhasePeaks::meet(std::size_t i, const Motion& motion, bool rests) {
  if (start_stop_[i] > 0) {
    const double jump = std::abs(motion.velocity - before_[i].velocity);
    const double rounding = velocity_rounding * proof_.axes[i].velocity.limit;
    if (rests && jump > rounding) {
      const double from_stop = std::abs(motion.velocity - stopped_[i]);
      raise_jump(i,
                 std::max({jump, std::abs(motion.velocity), std::abs(before_[i].velocity), at_rest_ ? from_stop : 0.0}),
                 start_stop_[i]);
    } else {
      raise_jump(i, jump, rounding);
    }
  } else {
    raise(proof_.axes[i].velocity_jump, motion.velocity - before_[i].velocity, 0);
  }
  raise(proof_.axes[i].acceleration_jump, motion.acceleration - before_[i].acceleration, 0);
}

// The jump that is the largest multiple of its limit is kept.
void PhasePeaks::raise_jump(std::size_t i, double jump, double limit) {
  Finding& finding = proof_.axes[i].velocity_jump;
  if (!(limit > 0) || !(jump > finding.multiple() * limit)) return;
  finding.limit = limit;
  finding.value = 0;
  raise(finding, jump, 0);
}

void PhasePeaks::check_gap(double gap) {
  raise(proof_.gap, gap, 0);
}

void PhasePeaks::rest(Seconds dwell) {
  for (std::size_t i = 0; i < before_.size(); ++i) {
    meet(i, {}, true);
    if (dwell > Seconds(0)) {
      stopped_[i] = 0;
    } else if (!at_rest_) {
      stopped_[i] = before_[i].velocity;
    }
    before_[i] = {};
  }
  at_rest_ = true;
  now_ += dwell;
}

void PhasePeaks::see_feed(const Segment& segment, const Phase& phase) {
  const double speed = segment.speed.value();
  if (!std::isfinite(speed)) return;
  const double duration = phase.duration.value();
  const double turn = phase.jerk.value() != 0 ? -phase.acceleration.value() / phase.jerk.value() : 0;
  for (const double t : {0.0, std::clamp(turn, 0.0, duration), duration}) {
    const double v = way_at(phase, t).v;
    if (!(v * proof_.feed.limit > proof_.feed.value * speed) && proof_.feed.limit > 0) continue;
    proof_.feed = {.value = v, .limit = speed, .time = now_ + Seconds(t), .line = line_};
  }
}

void PhasePeaks::measure(const ExactCurve& curve, const Phase& phase) {
  const double duration = phase.duration.value();
  const double turn = phase.jerk.value() != 0 ? -phase.acceleration.value() / phase.jerk.value() : 0;
  for (std::size_t i = 0; i < proof_.axes.size(); ++i) {
    for (const double t : {0.0, std::clamp(turn, 0.0, duration), duration}) {
      const Way way = way_at(phase, t);
      see(i, motion_of(curve.at(proof_.axes[i].axis, way.s), way), t);
    }
    // Under a falling limit the worst place of a phase with jerk may be anywhere, also on a line.
    if (!curve.is_line() || (limits_[i].falls() && phase.jerk.value() != 0)) measure_curved(curve, phase, i);
  }
}

void PhasePeaks::measure_curved(const ExactCurve& curve, const Phase& phase, std::size_t i) {
  const double duration = phase.duration.value();
  const auto motion_at = [&](double t) {
    const Way way = way_at(phase, t);
    return motion_of(curve.at(proof_.axes[i].axis, way.s), way);
  };
  const double share = (way_at(phase, duration).s - phase.start.value()) / curve.length();
  const int looks =
      static_cast<int>(std::clamp(curve.turning() * share / turn_between_looks, fewest_looks, most_looks));
  constexpr double Motion::*kinds[] = {&Motion::velocity, &Motion::acceleration, &Motion::jerk};
  Finding AxisProof::*const findings[] = {&AxisProof::velocity, &AxisProof::acceleration, &AxisProof::jerk};
  std::array<double, 3> best{};
  std::array<double, 3> where{};
  for (int k = 0; k <= looks; ++k) {
    const double t = duration * k / looks;
    const Motion motion = motion_at(t);
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const double here = kind == 1 ? severity(i, motion) : std::abs(motion.*kinds[kind]);
      if (!(here > best[kind])) continue;
      best[kind] = here;
      where[kind] = t;
    }
  }
  constexpr double worth_a_look = 0.9;
  constexpr double golden = 0.6180339887498949;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    Finding& finding = proof_.axes[i].*findings[kind];
    const bool falling = kind == 1 && limits_[i].falls();
    const double worst = falling ? finding.multiple() * limits_[i].constant() : finding.value;
    if (best[kind] < worth_a_look * worst) continue;
    const auto value = [&](double t) {
      return falling ? severity(i, motion_at(t)) : std::abs(motion_at(t).*kinds[kind]);
    };
    double low = std::max(where[kind] - duration / looks, 0.0);
    double high = std::min(where[kind] + duration / looks, duration);
    for (int pass = 0; pass < 30; ++pass) {
      const double a = high - golden * (high - low);
      const double b = low + golden * (high - low);
      (value(a) > value(b) ? high : low) = value(a) > value(b) ? b : a;
    }
    if (falling) {
      raise_acceleration(i, motion_at(where[kind]), where[kind]);
      raise_acceleration(i, motion_at((low + high) / 2), (low + high) / 2);
      continue;
    }
    raise(finding, best[kind], where[kind]);
    raise(finding, value((low + high) / 2), (low + high) / 2);
  }
}

}  // namespace passo::proof
