#include "phase_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rounding.hpp"

namespace passo::proof {
namespace {

constexpr double turn_between_looks = 0.05;  // radians
constexpr double end_of_curve = 1e-12;       // a share of its length
constexpr double fewest_looks = 12;
constexpr double most_looks = 4096;

}  // namespace

PhasePeaks::PhasePeaks(MotionProof& proof, const ProofOptions& options)
    : proof_(proof), before_(proof.axes.size()), stopped_(proof.axes.size()) {
  for (const ProvenAxis& axis : options.axes) {
    letters_.push_back(axis.axis);
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

// An absolute value. That of an acceleration under a falling limit is the share of the limit that it takes, expressed
// as mm/s² of the constant limit.
double PhasePeaks::severity(std::size_t i, const Motion& motion, Kind kind) const {
  if (kind != Kind::acceleration) return std::abs(kind == Kind::velocity ? motion.velocity : motion.jerk);
  const SpeedLimit& limit = limits_[i];
  const double value = std::abs(motion.acceleration);
  return limit.falls() ? value * limit.constant() / limit.at(motion.velocity) : value;
}

// The same for the worst motion so far.
double PhasePeaks::worst(std::size_t i, Kind kind) const {
  const AxisProof& axis = proof_.axes[i];
  if (kind == Kind::velocity) return axis.velocity.value;
  if (kind == Kind::jerk) return axis.jerk.value;
  return limits_[i].falls() ? axis.acceleration.multiple() * limits_[i].constant() : axis.acceleration.value;
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

void PhasePeaks::see(std::size_t i, const Motion& motion, double t, Kind kind) {
  AxisProof& axis = proof_.axes[i];
  switch (kind) {
    case Kind::velocity: return raise(axis.velocity, motion.velocity, t);
    case Kind::acceleration: return raise_acceleration(i, motion, t);
    case Kind::jerk: return raise(axis.jerk, motion.jerk, t);
  }
}

void PhasePeaks::watch(const PlannedMove& move, const ExactCurve& curve) {
  ++proof_.moves;
  line_ = move.segment.source.line;
  downs_ = move.segment.downs;
  bool begins_segment = move.from() == Mm(0);
  for (const Phase& phase : move) {
    ++proof_.phases;
    join(curve, phase, std::exchange(begins_segment, false) || at_rest_);
    at_rest_ = false;
    measure(curve, phase);
    see_feed(move.segment, phase);
    const Way end = way_at(phase, phase.duration.value());
    const ExactCurve::AllDerivatives slopes = curve.at(letters_, end.s);
    for (std::size_t i = 0; i < before_.size(); ++i) before_[i] = motion_of(slopes[i], end);
    place_ = motors_at(curve.place(end.s));
    now_ += phase.duration;
  }
  check_gap(distance(*place_, motors_at(curve.place(move.to.value()))));
  const bool ends_curve = move.to.value() >= curve.length() * (1 - end_of_curve);
  if (move.segment.mode == PathMode::exact_stop && ends_curve) stop_exactly();
}

// At an exact stop no axis may move, or none faster than it may stop at once.
void PhasePeaks::stop_exactly() {
  for (std::size_t i = 0; i < before_.size(); ++i) {
    const double rounding = velocity_rounding * proof_.axes[i].velocity.limit;
    raise_jump(i, std::abs(before_[i].velocity), std::max(start_stop_[i], rounding));
  }
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
  const ExactCurve::AllDerivatives slopes = curve.at(letters_, start.s);
  for (std::size_t i = 0; i < before_.size(); ++i) {
    meet(i, motion_of(slopes[i], start), rests);
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
  const Seconds duration = phase.duration;
  const ExactCurve::AllDerivatives slopes = curve.at(letters_, phase.start.value());
  if (!(duration > Seconds(0))) {
    for (std::size_t i = 0; i < letters_.size(); ++i) {
      for (const Kind kind : all_kinds) see(i, motion_of(slopes[i], way_at(phase, 0)), 0, kind);
    }
    return;
  }
  for (std::size_t i = 0; i < letters_.size(); ++i) {
    if (!curve.in_plane(letters_[i])) {
      if (slopes[i].first != 0 || slopes[i].second != 0 || slopes[i].third != 0)
        measure_polynomial(AxisPolynomial(slopes[i], phase), duration, i);
      continue;
    }
    const auto motion_at = [&](double t) {
      const Way way = way_at(phase, t);
      return motion_of(curve.at(letters_[i], way.s), way);
    };
    const double share = (way_at(phase, duration.value()).s - phase.start.value()) / curve.length();
    const double looks = std::clamp(curve.turning() * share / turn_between_looks, fewest_looks, most_looks);
    measure_looks(motion_at, duration.value(), static_cast<int>(looks), i, all_kinds);
  }
}

void PhasePeaks::measure_polynomial(const AxisPolynomial& polynomial, Seconds duration, std::size_t i) {
  using Order = AxisPolynomial::Order;
  const auto see_peak = [&](Finding& finding, Order order) {
    if (const auto peak = polynomial.peak_above(finding.value, order))
      raise(finding, peak->value, peak->u * duration.value());
  };
  AxisProof& axis = proof_.axes[i];
  see_peak(axis.velocity, Order::velocity);
  see_peak(axis.jerk, Order::jerk);
  if (!limits_[i].falls()) return see_peak(axis.acceleration, Order::acceleration);
  // Nowhere in the phase is the limit below that of the highest speed.
  const double fastest = polynomial.highest(Order::velocity);
  const double strongest = polynomial.highest(Order::acceleration);
  if (strongest <= axis.acceleration.multiple() * limits_[i].at(fastest)) return;
  const auto motion_at = [&](double t) {
    const double u = t / duration.value();
    return Motion{.velocity = polynomial.value(u, Order::velocity),
                  .acceleration = polynomial.value(u, Order::acceleration)};
  };
  measure_looks(motion_at, duration.value(), static_cast<int>(fewest_looks), i, std::array{Kind::acceleration});
}

// Looks at points of a phase at even times. If the best of them could be a new peak, it looks closely around it.
template <class MotionAt>
void PhasePeaks::measure_looks(const MotionAt& motion_at, double duration, int looks, std::size_t i,
                               std::span<const Kind> kinds) {
  std::array<double, 3> best{};
  std::array<double, 3> where{};
  for (int k = 0; k <= looks; ++k) {
    const double t = duration * k / looks;
    const Motion motion = motion_at(t);
    for (std::size_t n = 0; n < kinds.size(); ++n) {
      const double here = severity(i, motion, kinds[n]);
      if (!(here > best[n])) continue;
      best[n] = here;
      where[n] = t;
    }
  }
  constexpr double worth_a_look = 0.9;
  for (std::size_t n = 0; n < kinds.size(); ++n) {
    if (best[n] < worth_a_look * worst(i, kinds[n])) continue;
    see(i, motion_at(where[n]), where[n], kinds[n]);
    look_closely(motion_at, std::max(where[n] - duration / looks, 0.0), std::min(where[n] + duration / looks, duration),
                 i, kinds[n]);
  }
}

// A golden-section search. A peak is flat: half of its digits are enough for the time.
template <class MotionAt>
void PhasePeaks::look_closely(const MotionAt& motion_at, double low, double high, std::size_t i, Kind kind) {
  constexpr double golden = 0.6180339887498949;
  constexpr int passes = 20;
  const auto value = [&](double t) { return severity(i, motion_at(t), kind); };
  double a = high - golden * (high - low);
  double b = low + golden * (high - low);
  double at_a = value(a);
  double at_b = value(b);
  for (int pass = 0; pass < passes; ++pass) {
    if (at_a > at_b) {
      high = b;
      b = a;
      at_b = at_a;
      at_a = value(a = high - golden * (high - low));
    } else {
      low = a;
      a = b;
      at_a = at_b;
      at_b = value(b = low + golden * (high - low));
    }
  }
  const double t = (low + high) / 2;
  see(i, motion_at(t), t, kind);
}

}  // namespace passo::proof
