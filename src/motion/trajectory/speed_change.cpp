#include "speed_change.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "parabola.hpp"
#include "phase_chain.hpp"

namespace passo {
namespace {

// A trial that asks for too much lowers the strength or the jerk to what would have been right, in these bounds: not by
// less, or trials would creep up to a limit; not by more, because a weaker change lies elsewhere and may ask for less
// there.
constexpr double least_lowering = 0.97;
constexpr double most_lowering = 0.7;
// A jerk that is farther too strong comes this near at once: where the motion begins, no axis that moves has a limit of
// jerk, or one that has moves little.
constexpr double nearly = 2;
// Trials that end near a segment's end count as so much too strong: the least lowering.
constexpr double laid_badly = 1.03;
// A change of less than this share of what the limits allow at the start would take fifty times as long as it should.
// The plan before goes on instead. The hardest lowering gets there in 11 trials, so a change has more than twice that.
constexpr double weakest = 0.02;
constexpr int most_trials = 30;
constexpr int most_trials_in_steps = 10;
// In that trial a change of one strength that still asks for so much too much is hopeless.
constexpr int hopeless_in = 8;
constexpr double hopeless = 1.05;
// A change that leaves less than this share of the speed is a stop in all but name: near the end of a stop, what is
// left when the acceleration has gone is rounding. From there a plan would creep for ages; from rest it starts at once.
constexpr double least_left = 1e-3;

constexpr double rounding_of_limits =
    1e-6;  // share of a limit: far above that of doubles, far below what a motor feels
// On curves a parabola through each three looks tells what lies between them. Over this turn, in radians, its error is
// about turn³, a thousandth of the share of the limits that is left for it.
constexpr double turn_a_look = 0.02;
constexpr double looked_at = 0.999;
// Where the torque falls with the speed, the limit has kinks between the looks.
constexpr double looked_at_of_falling = 0.99;
// The profile itself uses up to 0.999 of a limit (share_seen_closely), and so does what is led by pieces of it.
constexpr double accepted = 1.0005;
// A piece that turns little still speeds up and slows down: its demands change with the cube of the time at most, which
// these looks follow. A limit that falls has kinks besides. The last bounds the time: a piece of more turns is rare.
constexpr int fewest_looks = 12;
constexpr int fewest_of_falling = 24;
constexpr int most_looks = 200;
// A piece shorter than a third of the change has fewer, in proportion.
constexpr int fewest_of_short = 3;
constexpr double whole_pieces = 3;

// In mm. What a phase goes beyond a segment's end by rounding: places of up to a metre are 1e-13 apart.
constexpr double smallest_way = 1e-11;
// After the end of a change, so much of the segment is left: it is cut like a whole segment, and cells need a length of
// their own. In mm or degrees of the axis that moves the most, as a share of the segment, and in seconds at the speed
// at which the change begins. The least of the three is enough: a stop that waits for the segment's end comes no later.
constexpr double smallest_rest = 0.02;
constexpr double smallest_part = 0.2;
constexpr double shortest_rest = 0.01;
// Times the unseen jump: the profile accepts as much (most_above_cap, jerk_profile_phases.cpp).
constexpr double most_unseen_jump = 4;

constexpr int slices_of_speed = 8;  // of a limit that falls with the speed

// Even if all steps were halvings, about 53 would exhaust the digits of a double.
constexpr int most_steps = 100;

// The time within the phase at which the motion is at s.
double time_at(const Phase& phase, double s) {
  double low = 0;
  double high = phase.duration.value();
  double time = (low + high) / 2;
  for (int i = 0; i < most_steps && low < high; ++i) {
    const double missing = s - phase.position_at(Seconds(time)).value();
    (missing > 0 ? low : high) = time;
    const double newton = time + missing / phase.velocity_at(Seconds(time)).value();
    const double next = newton > low && newton < high ? newton : (low + high) / 2;
    if (std::abs(next - time) <= shortest_phase / 1000) break;
    time = next;
  }
  return time;
}

}  // namespace

double least_rest(const Curve& curve, double speed) {
  const Point steepest = curve.steepest();
  const double most = std::ranges::max(steepest.values);
  return std::min({smallest_rest / std::max(most, 1.0), smallest_part * curve.length().value(), shortest_rest * speed});
}

std::optional<SpeedChange> SpeedChange::plan(PathAhead& path, const PathState& state, const Request& request) {
  std::optional<SpeedChange> change = plan(path, state, request, Way::of_one_strength);
  return change ? change : plan(path, state, request, Way::in_steps);
}

std::optional<SpeedChange> SpeedChange::plan(PathAhead& path, const PathState& state, const Request& wanted, Way way) {
  const Segment* first = path.at(state.segment);
  if (first == nullptr) return std::nullopt;
  const Strength most = strength_at(*first, state, wanted.axes);
  Strength strength = most;
  const double least = wanted.exit > 0 ? least_left * state.speed : 0;  // of the speed that is left
  Request request = wanted;
  if (wanted.exit == 0) request.exit = stop_speed(path, state, wanted);
  SpeedChange change;
  const int most_of_way = way == Way::in_steps ? most_trials_in_steps : most_trials;
  for (int trial = 0; trial < most_of_way; ++trial) {
    const Strength share{.acceleration = strength.acceleration / most.acceleration, .jerk = strength.jerk / most.jerk};
    const bool shaped = way == Way::in_steps ? change.shape_in_steps(path, state, request, strength, share)
                                             : change.shape(state, request.exit, least, strength);
    if (!shaped) return std::nullopt;
    const Laid laid = change.lay(path, state);
    if (laid == Laid::blocked) return std::nullopt;
    Demand worst{.force = laid_badly, .jolt = laid_badly};  // with another strength it ends at another place
    if (laid == Laid::whole) {
      worst = change.excess(path, request);
      if (worst.speed > 1) return std::nullopt;
      if (worst.force <= 1 && worst.jolt <= 1) {
        if (wanted.exit == 0) {
          // The path may have turned.
          if (change.end_.speed > stop_speed(path, change.end_, wanted) * (1 + rounding_of_limits)) return std::nullopt;
          change.end_.speed = 0;
        }
        const double exit = change.end_.speed;
        change.braking_way_ = exit * (exit / most.acceleration + most.acceleration / most.jerk) / 2;
        return change;
      }
    }
    if (trial >= hopeless_in && worst.jolt > hopeless) break;
    if (worst.force > 1) strength.acceleration *= std::clamp(1 / worst.force, most_lowering, least_lowering);
    if (worst.jolt > 1) {
      strength.jerk *= std::min(std::clamp(1 / worst.jolt, most_lowering, least_lowering), nearly / worst.jolt);
    }
    if (strength.acceleration < weakest * most.acceleration) break;
    // A jerk matters where the acceleration rises for longer than braking takes.
    const bool is_slow = strength.acceleration / strength.jerk > state.speed / strength.acceleration;
    if (strength.jerk < weakest * most.jerk && is_slow) break;
  }
  return std::nullopt;
}

std::optional<SpeedChange> SpeedChange::to_rest(const std::vector<Piece>& pieces, const PathState& end, PathAhead& path,
                                                const Request& request) {
  SpeedChange change;
  change.pieces_ = pieces;
  change.end_ = {.segment = end.segment, .s = end.s};
  const Demand worst = change.excess(path, request);
  if (worst.speed > 1 || worst.force > accepted || worst.jolt > accepted) return std::nullopt;
  return change;
}

SpeedChange::Strength SpeedChange::strength_at(const Segment& segment, const PathState& state,
                                               const std::vector<LimitedAxis>& axes) {
  const Point slope = segment.curve.tangent(Mm(state.s));
  Strength strength{.acceleration = strongest, .jerk = sharpest};
  for (const LimitedAxis& axis : axes) {
    const double part = std::abs(axis.row.of(slope));
    if (!(part > 0)) continue;
    const double speed = part * state.speed;
    strength.acceleration = std::min(strength.acceleration, axis.acceleration_at(speed * speed) / part);
    strength.jerk = std::min(strength.jerk, axis.jerk / part);
  }
  return strength;
}

// The speed from which the motors may stop at once at that place, without acceleration along the path. The acceleration
// of no axis with a jerk limit jumps there where the path bends, and no axis exceeds a limit.
double SpeedChange::stop_speed(PathAhead& path, const PathState& at, const Request& request) {
  const Segment* const segment = request.stops != nullptr ? path.at(at.segment) : nullptr;
  if (segment == nullptr) return 0;
  const Curve& curve = segment->curve;
  double cap = request.stops->at_end(curve.tangent(Mm(at.s)));
  for (const LimitedAxis& axis : request.axes) {
    const double bend = std::abs(axis.row.of(curve.second_derivative(Mm(at.s))));
    const double third = std::abs(axis.row.of(curve.third_derivative(Mm(at.s))));
    if (bend > 0) cap = std::min(cap, (axis.limits_jerk() ? unseen_jump : looked_at) * axis.acceleration / bend);
    if (third > 0) cap = std::min(cap, std::pow(axis.jerk / third, 2.0 / 3));
  }
  return std::sqrt(cap);
}

Seconds SpeedChange::shortest_stop(PathAhead& path, const PathState& state, const Request& request) {
  const Segment* const segment = path.at(state.segment);
  if (segment == nullptr) return Seconds(0);
  const double jerk = strength_at(*segment, state, request.axes).jerk;
  const double lost = std::max(state.speed - stop_speed(path, state, request), 0.0);
  // Where the torque falls with the speed, more torque is available as the motion slows down: the mean of the
  // slownesses counts.
  double slowness = 0;
  for (int i = 0; i < slices_of_speed; ++i) {
    const PathState slower{.s = state.s, .speed = state.speed - lost * (i + 0.5) / slices_of_speed};
    slowness += 1 / (slices_of_speed * strength_at(*segment, slower, request.axes).acceleration);
  }
  const double strongest_mean = 1 / slowness;
  const double rise = strongest_mean / jerk;
  const double begun = std::clamp(state.acceleration, -strongest_mean, strongest_mean);
  // Like a stop that begins without acceleration, at a higher speed.
  const double speed = lost + begun * begun / (2 * jerk);
  // Where the acceleration does not rise to the strongest.
  const bool is_slow = speed < strongest_mean * rise;
  return Seconds(std::max((is_slow ? 2 * std::sqrt(speed / jerk) : speed / strongest_mean + rise) + begun / jerk, 0.0));
}

void SpeedChange::add(double duration, double jerk) {
  if (const auto phase = chain_.next(duration, jerk)) phases_.push_back(*phase);
}

Seconds SpeedChange::duration_from(std::size_t piece) const {
  Seconds sum{0};
  for (; piece < pieces_.size(); ++piece) sum += pieces_[piece].phase.duration;
  return sum;
}

// The acceleration goes to -p, stays there and goes back to 0, where p is the strongest braking. Returns false where
// the speed must fall below 0, or to hardly any although some is wanted.
bool SpeedChange::shape(const PathState& state, double exit, double least, const Strength& strength) {
  const double v = state.speed;
  const double a = state.acceleration;
  const double j = strength.jerk;
  phases_.clear();
  chain_ = {.speed = v, .acceleration = a};
  const double eased = v + a * std::abs(a) / (2 * j);
  if (eased <= exit || eased <= 0) {
    end_.speed = eased;
    if (!(eased > least)) return false;
    add(std::abs(a) / j, a > 0 ? -j : j);
    return true;
  }
  end_.speed = exit;
  const double sharpest_peak = std::sqrt(j * (v - exit) + a * a / 2);
  const double p = std::min(sharpest_peak, strength.acceleration);
  const bool too_strong = a < -p;  // braking is already too strong
  const double to_peak = std::abs(a + p) / j;
  const double lost = too_strong ? (a * a - p * p) / (2 * j) : (p * p - a * a) / (2 * j);
  add(to_peak, too_strong ? j : -j);
  chain_.acceleration = -p;  // also where nothing limits the jerk, and that takes no time
  add((v - lost - p * p / (2 * j) - exit) / p, 0);
  add(p / j, j);
  return true;
}

// Lays the phases on the path: cuts them where segments end.
SpeedChange::Laid SpeedChange::lay(PathAhead& path, const PathState& state) {
  pieces_.clear();
  end_.segment = state.segment;
  double base = -state.s;  // the segment's start, counted as the phases are
  const Segment* segment = path.at(end_.segment);
  double end = base + segment->curve.length().value();
  for (Phase phase : phases_) {
    while (phase.position_at(phase.duration).value() > end + smallest_way) {
      const double time = time_at(phase, end);
      Phase before = phase;
      before.duration = Seconds(time);
      before.start = phase.start - Mm(base);
      if (time > shortest_phase) pieces_.push_back({.segment = end_.segment, .phase = before});
      if (pieces_.empty() || pieces_.back().segment != end_.segment) return Laid::blocked;
      pieces_.back().ends_segment = true;
      phase = phase.after(Seconds(time));
      phase.start = Mm(end);
      segment = path.after(end_.segment++);
      if (segment == nullptr) return Laid::blocked;
      base = end;
      end = base + segment->curve.length().value();
    }
    if (!(phase.duration.value() > shortest_phase)) continue;
    phase.start = phase.start - Mm(base);
    pieces_.push_back({.segment = end_.segment, .phase = phase});
  }
  end_.s = chain_.at - base;
  return end - chain_.at > least_rest(segment->curve, state.speed) ? Laid::whole : Laid::near_an_end;
}

SpeedChange::Demand SpeedChange::excess(PathAhead& path, const Request& request) const {
  Excess worst;
  const Seconds whole = duration_from(0);
  for (const Piece& piece : pieces_) {
    const Segment& segment = *path.at(piece.segment);
    check_piece(piece, piece.phase.duration / whole, segment, request, worst);
    if (!piece.ends_segment || &piece == &pieces_.back()) continue;  // the last one ends at rest
    // The profile passes a place slowly where the path's bend jumps. So does the change.
    const Segment& after = *path.at(piece.segment + 1);
    const Point jump = after.curve.second_derivative(Mm(0)) - segment.curve.second_derivative(segment.curve.length());
    const double speed = piece.phase.velocity_at(piece.phase.duration).value();
    for (const LimitedAxis& axis : request.axes) {
      if (!axis.limits_jerk()) continue;
      const double seen = std::abs(axis.row.of(jump)) * speed * speed;
      worst.most.force = std::max(worst.most.force, seen / (most_unseen_jump * unseen_jump * axis.acceleration));
    }
  }
  return worst.most;
}

void SpeedChange::check_piece(const Piece& piece, double part, const Segment& segment, const Request& request,
                              Excess& worst) {
  const Phase& phase = piece.phase;
  const double time = phase.duration.value();
  const double way = phase.position_at(phase.duration).value() - phase.start.value();
  const bool falls = std::ranges::any_of(request.axes, [](const LimitedAxis& axis) { return axis.falling != nullptr; });
  int count = 1;  // on a line the demand is greatest at an end or where the phase turns
  if (falls || segment.curve.shape() != Curve::Shape::line) {
    const double by_turn = std::ceil(way * segment.curve.curvature() / turn_a_look);
    const int fewest = falls ? fewest_of_falling : fewest_looks;
    // A planned piece is a whole cell, in which the acceleration may change a lot.
    const double of_part =
        request.planned ? fewest : std::clamp<double>(whole_pieces * part * fewest, fewest_of_short, fewest);
    count = static_cast<int>(std::clamp<double>(by_turn, std::ceil(of_part), most_looks));
  }
  std::array<Look, 3> looks;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(count); ++k) {
    looks[k % looks.size()] = look_at(piece, segment, request, time * static_cast<double>(k) / count);
    worst.raise(looks[k % looks.size()]);
    if (k >= 2) worst.raise_between(looks, k % looks.size());
  }
  // The speed is highest where it stops rising.
  const double turn = phase.jerk.value() < 0 ? phase.acceleration.value() / -phase.jerk.value() : -1;
  const bool turns = turn > 0 && turn < time;
  if (turns) worst.raise(look_at(piece, segment, request, turn));
  const double fastest_here = std::max({phase.velocity.value(), phase.velocity_at(phase.duration).value(),
                                        turns ? phase.velocity_at(Seconds(turn)).value() : 0});
  worst.most.speed =
      std::max(worst.most.speed, fastest_here / request.feeds.speed_on(segment) * (1 - rounding_of_limits));
}

void SpeedChange::Excess::raise(const Look& look) {
  for (std::size_t k = 0; k < look.count; ++k) {
    most.speed = std::max(most.speed, std::abs(look.axes[k].speed));
    most.force = std::max(most.force, std::abs(look.axes[k].force));
    most.jolt = std::max(most.jolt, std::abs(look.axes[k].jolt));
  }
}

// Adds the demand between looks: by parabolas through the last three looks, of which `newest` is the newest.
void SpeedChange::Excess::raise_between(const std::array<Look, 3>& looks, std::size_t newest) {
  for (std::size_t k = 0; k < looks[newest].count; ++k) {
    const Demand& first = looks[(newest + 1) % looks.size()].axes[k];
    const Demand& second = looks[(newest + 2) % looks.size()].axes[k];
    const Demand& third = looks[newest].axes[k];
    most.speed = std::max(most.speed, highest_through({first.speed, second.speed, third.speed}));
    most.force = std::max(most.force, highest_through({first.force, second.force, third.force}));
    most.jolt = std::max(most.jolt, highest_through({first.jolt, second.jolt, third.jolt}));
  }
}

SpeedChange::Look SpeedChange::look_at(const Piece& piece, const Segment& segment, const Request& request,
                                       double time) {
  const Phase& phase = piece.phase;
  const Seconds t(time);
  const Mm s = std::clamp(phase.position_at(t), Mm(0), segment.curve.length());
  const double v = phase.velocity_at(t).value();
  const double a = phase.acceleration_at(t).value();
  const double j = phase.jerk.value();
  const Point first = segment.curve.tangent(s);
  const Point second = segment.curve.second_derivative(s);
  const Point third = segment.curve.third_derivative(s);
  const bool is_line = segment.curve.shape() == Curve::Shape::line;
  Look look;
  look.count = request.axes.size();
  for (std::size_t k = 0; k < look.count; ++k) {
    const LimitedAxis& axis = request.axes[k];
    const double q1 = axis.row.of(first);
    const double q2 = axis.row.of(second);
    const double q3 = axis.row.of(third);
    const double seen = axis.falling != nullptr && !request.planned ? looked_at_of_falling : looked_at;
    const double share = is_line ? 1 + rounding_of_limits : seen;
    look.axes[k] = {.speed = q1 * v / axis.velocity * (1 - rounding_of_limits),
                    .force = (q1 * a + q2 * v * v) / (axis.acceleration_at(q1 * q1 * v * v) * share),
                    .jolt = (q1 * j + 3 * q2 * v * a + q3 * v * v * v) / (axis.jerk * share)};
  }
  return look;
}

}  // namespace passo
