#include "phase_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rounding.hpp"

namespace passo::proof {
namespace {

constexpr double turn_between_looks = 0.05;  // radians
constexpr double start_of_curve = 1e-12;     // mm; what a move leaves out there shows as a gap
constexpr double end_of_curve = 1e-12;       // a share of its length
constexpr double fewest_looks = 12;
constexpr double most_looks = 4096;

}  // namespace

PhasePeaks::PhasePeaks(MotionProof& proof, const ProofOptions& options, const std::vector<SpeedLimit>& limits)
    : proof_(proof), limits_(limits), before_(proof.axes.size()), stopped_(proof.axes.size()) {
  for (const ProvenAxis& axis : options.axes) {
    letters_.push_back(axis.axis);
    start_stop_.push_back(axis.start_stop.value());
    backlash_[axis.axis] = axis.backlash.value();
    if (axis.surface_radius) surface_radius_[axis.axis] = axis.surface_radius->value();
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

void PhasePeaks::watch(const PlannedMove& move, const ExactCurve& curve, double programmed_speed) {
  ++proof_.moves;
  line_ = move.segment.source.line;
  downs_ = move.segment.downs;
  bool begins_segment = move.from().value() <= std::max(curve.length() * end_of_curve, start_of_curve);
  for (const Phase& phase : move) {
    ++proof_.phases;
    join(curve, phase, std::exchange(begins_segment, false) || at_rest_);
    at_rest_ = false;
    measure(curve, phase);
    if (counts_surface(move.segment, curve)) {
      see_surface_feed(move.segment, curve, phase,
                       programmed_speed > 0 ? programmed_speed : move.segment.speed.value());
    } else {
      see_feed(move.segment, phase);
    }
    const Way end = way_at(phase, phase.duration.value());
    const ExactCurve::AllDerivatives slopes = curve.at(letters_, end.s);
    for (std::size_t i = 0; i < before_.size(); ++i) before_[i] = motion_of(slopes[i], end);
    place_ = motors_at(curve.place(end.s));
    now_ += phase.duration;
  }
  check_gap(distance(*place_, motors_at(curve.place(move.to.value()))));
  const bool ends_curve = move.to.value() >= curve.length() * (1 - end_of_curve);
  if (move.segment.mode == PathMode::exact_stop && ends_curve) stop_exactly();
  if (move.stops_at_once) rest(Seconds(0));
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
  bool jumps = false;
  for (std::size_t i = 0; i < before_.size(); ++i) {
    const Motion motion = motion_of(slopes[i], start);
    jumps =
        jumps || std::abs(motion.velocity - before_[i].velocity) > velocity_rounding * proof_.axes[i].velocity.limit;
    meet(i, motion, rests);
    stopped_[i] = 0;
  }
  if (!rests || !jumps) return;
  // Where axes jump to their velocities and from them, none has an acceleration.
  for (std::size_t i = 0; i < before_.size(); ++i) {
    raise(proof_.axes[i].acceleration_jump, before_[i].acceleration, 0);
    raise(proof_.axes[i].acceleration_jump, motion_of(slopes[i], start).acceleration, 0);
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

PhasePeaks::Range PhasePeaks::range_of(const Phase& phase) {
  const double duration = phase.duration.value();
  const Way start = way_at(phase, 0);
  const Way end = way_at(phase, duration);
  Range range{.way = end.s - start.s,
              .velocity = std::abs(start.v),
              .acceleration = std::abs(start.a),
              .jerk = std::abs(start.j)};
  const auto see_velocity = [&](double v, double t) {
    if (!(std::abs(v) > range.velocity)) return;
    range.velocity = std::abs(v);
    range.fastest_at = t;
  };
  see_velocity(end.v, duration);
  const double turn = start.j != 0 ? -start.a / start.j : 0;
  if (turn > 0 && turn < duration) see_velocity(way_at(phase, turn).v, turn);
  if (std::abs(end.a) > range.acceleration) {
    range.acceleration = std::abs(end.a);
    range.strongest_at = duration;
  }
  return range;
}

// The slope is a parabola of s: it lies between its Bernstein coefficients.
PhasePeaks::Motion PhasePeaks::bounds_of(const Derivatives& slopes, const Range& range) {
  const double middle = slopes.first + slopes.second * range.way / 2;
  const double end = middle + (slopes.second + slopes.third * range.way) * range.way / 2;
  const double first = std::max({std::abs(slopes.first), std::abs(middle), std::abs(end)});
  const double second = std::max(std::abs(slopes.second), std::abs(slopes.second + slopes.third * range.way));
  const double v = range.velocity;
  return {.velocity = first * v,
          .acceleration = first * range.acceleration + second * v * v,
          .jerk = std::abs(slopes.third) * v * v * v + 3 * second * v * range.acceleration + first * range.jerk};
}

// An axis in the plane of an arc has at most the size of each derivative.
PhasePeaks::Motion PhasePeaks::bounds_in_plane(const ExactCurve& curve, double from, const Range& range) {
  const Derivatives before = curve.sizes_in_plane(from);
  const Derivatives after = curve.sizes_in_plane(from + range.way);
  const double first = std::max(before.first, after.first);
  const double second = std::max(before.second, after.second);
  const double third = std::max(before.third, after.third);
  const double v = range.velocity;
  return {.velocity = first * v,
          .acceleration = first * range.acceleration + second * v * v,
          .jerk = third * v * v * v + 3 * second * v * range.acceleration + first * range.jerk};
}

// Under a falling limit, the lowest limit in the phase is that of the highest speed.
bool PhasePeaks::can_be_worst(std::size_t i, const Motion& bounds, Kind kind) const {
  const AxisProof& axis = proof_.axes[i];
  switch (kind) {
    case Kind::velocity: return bounds.velocity > axis.velocity.value;
    case Kind::jerk: return bounds.jerk > axis.jerk.value;
    case Kind::acceleration: break;
  }
  if (!limits_[i].falls()) return bounds.acceleration > axis.acceleration.value;
  return bounds.acceleration > axis.acceleration.multiple() * limits_[i].at(bounds.velocity);
}

void PhasePeaks::measure(const ExactCurve& curve, const Phase& phase) {
  const ExactCurve::AllDerivatives slopes = curve.at(letters_, phase.start.value());
  if (!(phase.duration > Seconds(0))) {
    for (std::size_t i = 0; i < letters_.size(); ++i) {
      for (const Kind kind : all_kinds) see(i, motion_of(slopes[i], way_at(phase, 0)), 0, kind);
    }
    return;
  }
  const Range range = range_of(phase);
  for (std::size_t i = 0; i < letters_.size(); ++i) {
    if (curve.in_plane(letters_[i])) continue;
    const auto& [first, second, third] = slopes[i];
    const bool is_straight = second == 0 && third == 0;
    if (is_straight && first == 0) continue;
    if (is_straight && !limits_[i].falls()) {
      measure_line(first, range, i);
    } else if (phase.jerk.value() == 0) {
      measure_even(EvenMotion(slopes[i], phase), i);
    } else {
      measure_polynomial(slopes[i], phase, range, i);
    }
  }
  if (!curve.is_line() && !curve.is_cubic()) measure_arc(curve, phase, range);
}

void PhasePeaks::measure_line(double slope, const Range& range, std::size_t i) {
  AxisProof& axis = proof_.axes[i];
  raise(axis.velocity, slope * range.velocity, range.fastest_at);
  raise(axis.acceleration, slope * range.acceleration, range.strongest_at);
  raise(axis.jerk, slope * range.jerk, 0);
}

void PhasePeaks::measure_even(const EvenMotion& motion, std::size_t i) {
  using Order = EvenMotion::Order;
  const auto see_peak = [&](Finding& finding, Order order) {
    if (const auto peak = motion.peak_above(finding.value, order)) raise(finding, peak->value, peak->time);
  };
  AxisProof& axis = proof_.axes[i];
  see_peak(axis.velocity, Order::velocity);
  see_peak(axis.jerk, Order::jerk);
  if (limits_[i].falls()) return measure_torque(motion, i);
  see_peak(axis.acceleration, Order::acceleration);
}

// Cuts the phase in halves. A part whose highest acceleration is no new peak under the limit of its highest speed is
// done.
void PhasePeaks::measure_torque(const EvenMotion& motion, std::size_t i) {
  using Order = EvenMotion::Order;
  constexpr double precision = 1e-6;
  constexpr int most_halvings = 30;
  struct Part {
    double from = 0;
    double to = 0;
    int halvings = 0;
  };
  const Finding& worst = proof_.axes[i].acceleration;
  const auto see_at = [&](double way) {
    const Motion here{.velocity = motion.value(way, Order::velocity),
                      .acceleration = motion.value(way, Order::acceleration)};
    raise_acceleration(i, here, motion.time_at(way));
  };
  std::array<Part, most_halvings + 2> waiting;
  std::size_t parts = 0;
  waiting[parts++] = {.from = 0, .to = motion.way()};
  while (parts > 0) {
    const Part part = waiting[--parts];
    const double strongest = motion.highest(Order::acceleration, part.from, part.to);
    const double limit = limits_[i].at(motion.highest(Order::velocity, part.from, part.to));
    if (strongest <= worst.multiple() * limit * (1 + precision)) continue;
    see_at(part.from);
    see_at(part.to);
    if (part.halvings == most_halvings) continue;
    const double middle = (part.from + part.to) / 2;
    waiting[parts++] = {.from = middle, .to = part.to, .halvings = part.halvings + 1};
    waiting[parts++] = {.from = part.from, .to = middle, .halvings = part.halvings + 1};
  }
}

void PhasePeaks::measure_polynomial(const Derivatives& slopes, const Phase& phase, const Range& range, std::size_t i) {
  using Order = AxisPolynomial::Order;
  const Motion bounds = bounds_of(slopes, range);
  if (std::ranges::none_of(all_kinds, [&](Kind kind) { return can_be_worst(i, bounds, kind); })) return;
  const Seconds duration = phase.duration;
  const AxisPolynomial polynomial(slopes, phase);
  const auto see_peak = [&](Finding& finding, Order order) {
    if (const auto peak = polynomial.peak_above(finding.value, order))
      raise(finding, peak->value, peak->u * duration.value());
  };
  AxisProof& axis = proof_.axes[i];
  if (can_be_worst(i, bounds, Kind::velocity)) see_peak(axis.velocity, Order::velocity);
  if (can_be_worst(i, bounds, Kind::jerk)) see_peak(axis.jerk, Order::jerk);
  if (!can_be_worst(i, bounds, Kind::acceleration)) return;
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
  constexpr auto looks = static_cast<int>(fewest_looks);
  measure_looks([&](int k) { return motion_at(duration.value() * k / looks); }, motion_at, duration.value(), fastest,
                looks, i, std::array{Kind::acceleration});
}

void PhasePeaks::measure_arc(const ExactCurve& curve, const Phase& phase, const Range& range) {
  const Motion bounds = bounds_in_plane(curve, phase.start.value(), range);
  const double duration = phase.duration.value();
  const double turn = curve.turning() * range.way / curve.length();
  const auto looks = static_cast<int>(std::clamp(turn / turn_between_looks, fewest_looks, most_looks));
  looks_.clear();
  for (std::size_t i = 0; i < letters_.size(); ++i) {
    if (!curve.in_plane(letters_[i])) continue;
    std::array<Kind, all_kinds.size()> kinds{};
    std::size_t count = 0;
    for (const Kind kind : all_kinds) {
      if (can_be_worst(i, bounds, kind)) kinds[count++] = kind;
    }
    if (count == 0) continue;
    for (int k = static_cast<int>(looks_.size()); k <= looks; ++k) {
      const Way way = way_at(phase, duration * k / looks);
      looks_.push_back({.way = way, .slopes = curve.at(letters_, way.s)});
    }
    const auto motion_of_look = [&](int k) {
      const Look& look = looks_[static_cast<std::size_t>(k)];
      return motion_of(look.slopes[i], look.way);
    };
    const auto motion_at = [&](double t) {
      const Way way = way_at(phase, t);
      return motion_of(curve.at(letters_[i], way.s), way);
    };
    measure_looks(motion_of_look, motion_at, duration, bounds.velocity, looks, i, std::span(kinds).first(count));
  }
}

// Looks at points of a phase at even times. If the best of them could be a new peak, it looks closely around it. On an
// arc the highest value between two looks is hardly higher than at the nearer one.
template <class MotionOfLook, class MotionAt>
void PhasePeaks::measure_looks(const MotionOfLook& motion_of_look, const MotionAt& motion_at, double duration,
                               double fastest, int looks, std::size_t i, std::span<const Kind> kinds) {
  constexpr double worth_a_look = 0.98;
  const SpeedLimit& limit = limits_[i];
  for (const Kind kind : kinds) {
    // No look has a lower limit than the fastest one. Most need not be compared with their own.
    const bool falls = kind == Kind::acceleration && limit.falls();
    const double harshest = falls ? limit.constant() / limit.at(fastest) : 1;
    double best = worth_a_look * worst(i, kind);
    int where = -1;
    for (int k = 0; k <= looks; ++k) {
      const Motion motion = motion_of_look(k);
      if (falls && std::abs(motion.acceleration) * harshest <= best) continue;
      const double here = severity(i, motion, kind);
      if (!(here > best)) continue;
      best = here;
      where = k;
    }
    if (where < 0) continue;
    see(i, motion_of_look(where), duration * where / looks, kind);
    look_closely(motion_at, duration * std::max(where - 1, 0) / looks, duration * std::min(where + 1, looks) / looks, i,
                 kind);
  }
}

// A golden-section search. A peak is flat: a few digits of the time are enough for twice as many of the value.
template <class MotionAt>
void PhasePeaks::look_closely(const MotionAt& motion_at, double low, double high, std::size_t i, Kind kind) {
  constexpr double golden = 0.6180339887498949;
  constexpr int passes = 12;
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
