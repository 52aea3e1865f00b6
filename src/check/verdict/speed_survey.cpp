#include "passo/verdict/speed_survey.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/geometry/curve_derivatives.hpp"
#include "passo/geometry/euclid.hpp"
#include "passo/geometry/only_turns.hpp"

namespace passo {
namespace {

// A limit counts as reached from this share of it on: the planner's cells and rounding leave some of it.
constexpr double nearly_all = 0.97;

// Keeps the greatest by `key`, the greatest first.
template <class Key>
void keep(std::vector<SpeedPart>& parts, const SpeedPart& part, Key key) {
  if (parts.size() == SpeedSurvey::most_parts && !(key(parts.back()) < key(part))) return;
  const auto place = std::ranges::find_if(parts, [&](const SpeedPart& other) { return key(other) < key(part); });
  parts.insert(place, part);
  if (parts.size() > SpeedSurvey::most_parts) parts.pop_back();
}

// How far the tool moves per millimetre of s: 1, except on a curve that replaces other segments and has their s, and
// where the motor takes up backlash.
double tool_way(const Segment& segment, Mm s, bool turns) {
  if (turns || segment.curve.shape() == Curve::Shape::line) return 1;
  Point slope = segment.curve.tangent(s);
  if (segment.lead) slope[segment.lead->axis] -= segment.lead->slope_at(s.value(), segment.curve.length().value());
  const double in_xyz = length_in(slope, CountedGroup::xyz, segment.surface);
  return in_xyz > 0 ? in_xyz : length_in(slope, CountedGroup::uvw);
}

}  // namespace

SpeedSurvey::SpeedSurvey(MotionLimits limits, AxisSet axes) : limits_(std::move(limits)) {
  for (const Axis axis : all_axes) {
    if (axes.has(axis)) axes_.push_back(axis);
  }
}

void SpeedSurvey::watch(const PlannedMove& move) {
  const Segment& segment = move.segment;
  const bool takes_up = segment.takes_up_backlash;
  const bool same_line = in_part_ && segment.source.line == part_.line;
  if (same_line && std::exchange(only_takes_up_, false)) {  // the line itself begins
    only_takes_up_ = takes_up;
    part_.rapid = segment.rapid;
    part_.turns = only_turns(segment.curve, segment.surface);
    part_.programmed = MmPerSecond(0);
    if (!part_.rapid) part_.lost = part_.time;
  } else if (!same_line || (segment.rapid != part_.rapid && !takes_up)) {
    end_part();
    in_part_ = true;
    highest_look_ = MmPerSecond(0);
    part_ = {.line = segment.source.line, .rapid = segment.rapid, .turns = only_turns(segment.curve, segment.surface)};
    only_takes_up_ = takes_up;
  }
  if (!takes_up) part_.way += move.to - move.from();
  const double curvature = segment.curve.curvature();
  for (const Phase& phase : move) watch_phase(move, phase, curvature);
}

// With constant acceleration a limit is reached in all of a phase or nowhere, if the path hardly turns in it.
void SpeedSurvey::watch_phase(const PlannedMove& move, const Phase& phase, double curvature) {
  constexpr double hardly_turns = 0.05;  // radians
  const Mm end = &phase + 1 == move.end() ? move.to : (&phase + 1)->start;
  const bool simple = phase.jerk.value() == 0 && (end - phase.start).value() * curvature < hardly_turns;
  const int looks = simple ? 1 : 3;
  const Seconds piece = phase.duration / looks;
  part_.time += phase.duration;
  for (int i = 0; i < looks; ++i) {
    const Seconds t = piece * (i + 0.5);
    const double way = tool_way(move.segment, phase.position_at(t), part_.turns);
    if (!move.segment.takes_up_backlash || only_takes_up_) {
      part_.programmed = std::max(part_.programmed, move.segment.speed * way);
    }
    const Found found = bound_at(move, phase, t);
    Reached& reached = this->reached(found.bound);
    if (reached.time == Seconds(0)) {
      reached.first_line = part_.line;
      reached.limit = found.limit;
    }
    reached.time += piece;
    const double share = phase.velocity_at(t) / move.segment.speed;  // 0 for a rapid
    if (!part_.rapid && share < 1) {
      if (reached.lost == Seconds(0)) touched_.push_back(static_cast<std::size_t>(&reached - reached_.data()));
      reached.lost += piece * (1 - share);
      part_.lost += piece * (1 - share);
    }
    if (move.segment.takes_up_backlash) continue;
    // Judged at the places of the looks: at its end a ramp is as fast as the even motion after it.
    if (phase.velocity_at(t) * way > highest_look_) {
      highest_look_ = phase.velocity_at(t) * way;
      at_highest_ = found.bound;
    }
    const MmPerSecond at_an_end = std::max(phase.velocity, phase.velocity_at(phase.duration));
    part_.highest = std::max({part_.highest, highest_look_, at_an_end * way});
  }
}

SpeedSurvey::Found SpeedSurvey::bound_at(const PlannedMove& move, const Phase& phase, Seconds t) const {
  using Kind = SpeedBound::Kind;
  const double v = phase.velocity_at(t).value();
  if (v >= nearly_all * move.segment.speed.value()) return {{.kind = Kind::feed}, 0};
  const Curve& curve = move.segment.curve;
  const double a = phase.acceleration_at(t).value();
  const double j = phase.jerk.value();
  const auto [slope, bend, twist] = derivatives_at(curve, phase.position_at(t));
  double most = nearly_all;
  Found found;
  const auto compare = [&](Kind kind, Axis axis, double value, double limit) {
    if (!(limit > 0) || !(value > most * limit)) return;
    most = value / limit;
    found = {{.kind = kind, .axis = axis}, kind == Kind::torque ? 0 : limit};  // a torque leaves less and less
  };
  for (const Axis axis : axes_) {
    const double speed = std::abs(slope[axis] * v);
    compare(Kind::velocity, axis, speed, limits_.velocity[axis].value());
    const double bending = bend[axis] * v * v;
    const double acceleration = std::abs(slope[axis] * a + bending);
    const double constant = limits_.acceleration[axis].value();
    const AccelerationCurve& falling = limits_.falling[axis];
    const double left = falling.empty() ? constant : falling.at(MmPerSecond(speed)).value();
    const Kind kind = 2 * std::abs(bending) > acceleration ? Kind::bending : Kind::acceleration;
    compare(left < constant ? Kind::torque : kind, axis, acceleration, std::min(left, constant));
    const double jerk = std::abs(slope[axis] * j + 3 * bend[axis] * v * a + twist[axis] * v * v * v);
    compare(Kind::jerk, axis, jerk, limits_.jerk[axis].value());
  }
  return found;
}

SpeedSurvey::Reached& SpeedSurvey::reached(const SpeedBound& bound) {
  return reached_[static_cast<std::size_t>(bound.kind) * axis_count + index_of(bound.axis)];
}

void SpeedSurvey::end_part() {
  if (!std::exchange(in_part_, false)) return;
  std::size_t worst = reached_.size();
  for (const std::size_t i : touched_) {
    if (worst == reached_.size() || reached_[worst].lost < reached_[i].lost) worst = i;
  }
  part_.bound = at_highest_;
  if (part_.rapid) {
    if (part_.highest > fastest_rapid_.highest) fastest_rapid_ = part_;
  } else {
    keep(fastest_, part_, [](const SpeedPart& part) { return part.highest; });
  }
  if (worst < reached_.size()) {
    part_.bound = {.kind = static_cast<SpeedBound::Kind>(worst / axis_count), .axis = all_axes[worst % axis_count]};
    keep(slowest_, part_, [](const SpeedPart& part) { return part.lost; });
  }
  for (const std::size_t i : touched_) reached_[i].lost = Seconds(0);
  touched_.clear();
}

SpeedReport SpeedSurvey::report() {
  end_part();
  SpeedReport report{.shares = {}, .slowest = slowest_, .fastest = fastest_};
  if (fastest_rapid_.highest > MmPerSecond(0)) report.fastest.push_back(fastest_rapid_);
  for (std::size_t i = 0; i < reached_.size(); ++i) {
    const Reached& reached = reached_[i];
    if (!(reached.time > Seconds(0))) continue;
    report.shares.push_back(
        {.bound = {.kind = static_cast<SpeedBound::Kind>(i / axis_count), .axis = all_axes[i % axis_count]},
         .time = reached.time,
         .first_line = reached.first_line,
         .limit = reached.limit});
  }
  std::ranges::stable_sort(report.shares, [](const SpeedShare& a, const SpeedShare& b) { return b.time < a.time; });
  return report;
}

std::string describe(const SpeedBound& bound) {
  const char letter = letter_of(bound.axis);
  switch (bound.kind) {
    case SpeedBound::Kind::feed: return "the programmed feed";
    case SpeedBound::Kind::velocity: return fmt::format("the velocity of {}", letter);
    case SpeedBound::Kind::acceleration: return fmt::format("the acceleration of {}", letter);
    case SpeedBound::Kind::bending: return fmt::format("the acceleration of {} in a curve", letter);
    case SpeedBound::Kind::torque: return fmt::format("the torque of {}'s motor", letter);
    case SpeedBound::Kind::jerk: return fmt::format("the jerk of {}", letter);
    case SpeedBound::Kind::passage: break;
  }
  return "no single limit";
}

}  // namespace passo
