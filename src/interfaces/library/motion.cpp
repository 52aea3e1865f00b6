#include <algorithm>
#include <cmath>

#include "inner_types.hpp"
#include "motion_content.hpp"
#include "path_content.hpp"
#include <fmt/format.h>

#include "passo/geometry/curve_derivatives.hpp"
#include "passo/geometry/only_turns.hpp"
#include "passo/path/path_smoother.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo::v1 {

MotionRecording::MotionRecording(const passo::Point& start, const passo::PerAxis<passo::MmPerSecond>& velocities)
    : content_(std::make_shared<Motion::Content>()) {
  content_->start = start;
  content_->velocities = velocities;
}

bool MotionRecording::add(const passo::MotionItem& item) {
  if (content_->moves.size() >= Motion::Content::most_moves) return false;
  if (const auto* move = std::get_if<passo::PlannedMove>(&item)) {
    add(*move);
  } else {
    add_rest(std::get<passo::Action>(item));
  }
  return true;
}

void MotionRecording::add(const passo::PlannedMove& move) {
  Motion::Content& content = *content_;
  if (move.phase_count == 0) return;
  if (!goes_on_) content.curves.push_back(move.segment.tool_curve());
  content.moves.push_back({.curve = static_cast<std::uint32_t>(content.curves.size() - 1),
                           .first_phase = static_cast<std::uint32_t>(content.phases.size()),
                           .phase_count = static_cast<std::uint16_t>(move.phase_count),
                           .downs = move.segment.downs,
                           .takes_up_backlash = move.segment.takes_up_backlash,
                           .line = move.segment.source.line,
                           .begin = content.duration,
                           .to = move.to.value()});
  content.phases.insert(content.phases.end(), move.begin(), move.end());
  content.duration += move.duration().value();
  content.has_backlash = content.has_backlash || move.segment.takes_up_backlash || move.segment.lead;
  if (!move.segment.takes_up_backlash && !passo::only_turns(move.segment.curve, move.segment.surface))
    content.length += (move.to - move.from()).value();
  goes_on_ = move.to < move.segment.curve.length();
}

void MotionRecording::add_rest(const passo::Action& action) {
  goes_on_ = false;
  if (!(action.dwell > passo::Seconds(0))) return;
  Motion::Content& content = *content_;
  if (content.curves.empty()) content.curves.push_back(passo::Curve::line(content.start, content.start));
  content.moves.push_back({.curve = static_cast<std::uint32_t>(content.curves.size() - 1),
                           .line = action.source.line,
                           .begin = content.duration,
                           .rest = action.dwell.value()});
  content.duration += action.dwell.value();
}

Motion MotionRecording::motion(std::optional<passo::StepOptions> machine) {
  content_->machine = std::move(machine);
  return Motion(std::move(content_));
}

bool StoredMoves::next(passo::MotionItem& item) {
  if (next_ >= motion_.moves.size()) return false;
  const StoredMove& stored = motion_.moves[next_++];
  const passo::OperationSource source{.line = stored.line};
  if (stored.phase_count == 0) {
    item = passo::Action{
        .kind = passo::Action::Kind::dwell, .dwell = passo::Seconds(stored.rest), .outputs = {}, .source = source};
    return true;
  }
  passo::PlannedMove move;
  move.segment.curve = motion_.curves[stored.curve];
  move.segment.downs = stored.downs;
  move.segment.takes_up_backlash = stored.takes_up_backlash;
  move.segment.source = source;
  for (std::size_t i = 0; i < stored.phase_count; ++i) move.add(motion_.phases[stored.first_phase + i]);
  move.to = passo::Mm(stored.to);
  item = move;
  return true;
}

void MotionCursor::seek(double time) {
  const std::vector<StoredMove>& moves = motion_.moves;
  constexpr std::size_t near = 8;
  for (std::size_t i = 0; i < near && move_ + 1 < moves.size() && moves[move_ + 1].begin <= time; ++i) ++move_;
  const bool is_here = moves[move_].begin <= time && (move_ + 1 == moves.size() || time < moves[move_ + 1].begin);
  if (is_here) return;
  const auto after = std::ranges::upper_bound(moves, time, {}, &StoredMove::begin);
  move_ = after == moves.begin() ? 0 : static_cast<std::size_t>(after - moves.begin()) - 1;
}

MotionState MotionCursor::at(double time) {
  MotionState state;
  if (motion_.moves.empty()) {
    state.position = position_of(motion_.start);
    return state;
  }
  // Also for a time that is no number.
  time = time > 0 ? std::min(time, motion_.duration) : 0;
  seek(time);
  const StoredMove& move = motion_.moves[move_];
  const passo::Curve& curve = motion_.curves[move.curve];
  state.piece = move.line;
  if (move.phase_count == 0 || move.takes_up_backlash) {
    state.position = position_of(curve.end());
    return state;
  }
  double left = time - move.begin;
  std::size_t i = 0;
  const auto phase_at = [&](std::size_t index) -> const passo::Phase& {
    return motion_.phases[move.first_phase + index];
  };
  for (; i + 1 < move.phase_count && left > phase_at(i).duration.value(); ++i) left -= phase_at(i).duration.value();
  const passo::Phase& phase = phase_at(i);
  const passo::Seconds t(std::min(left, phase.duration.value()));
  const passo::Mm s(std::clamp(phase.position_at(t).value(), 0.0, curve.length().value()));
  const double speed = std::max(phase.velocity_at(t).value(), 0.0);
  const double acceleration = phase.acceleration_at(t).value();
  const passo::CurveDerivatives by_length = passo::derivatives_at(curve, s);
  state.position = position_of(curve.at(s));
  state.velocity = position_of(by_length.first * speed);
  state.acceleration = position_of(by_length.first * acceleration + by_length.second * (speed * speed));
  state.speed_mm_per_s = speed;
  return state;
}

Motion::Motion(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

double Motion::duration_s() const {
  return content_->duration;
}

double Motion::length_mm() const {
  return content_->length;
}

MotionState Motion::at(double time_s) const {
  return MotionCursor(*content_).at(time_s);
}

void Motion::sample(double from_s, double interval_s, std::size_t count, MotionState* states) const {
  MotionCursor cursor(*content_);
  for (std::size_t i = 0; i < count; ++i) states[i] = cursor.at(from_s + static_cast<double>(i) * interval_s);
}

Outcome<Motion> plan(const Path& path, const Limits& limits) {
  if (std::vector<Finding> errors = errors_of(path.content(), limits); !errors.empty()) {
    return Outcome<Motion>(std::move(errors));
  }
  passo::MotionLimits inner_limits;
  for (const Axis axis : all_axes) {
    const AxisLimits& own = limits[axis];
    inner_limits.velocity[inner(axis)] = passo::MmPerSecond(own.velocity_mm_per_s);
    inner_limits.acceleration[inner(axis)] = passo::MmPerSecond2(own.acceleration_mm_per_s2);
    inner_limits.jerk[inner(axis)] = passo::MmPerSecond3(own.jerk_mm_per_s3);
  }
  PathPieces pieces(path.content());
  passo::PathSmoother smoother(
      pieces, inner_limits.limits_jerk() ? passo::Smoothness::slow_bending : passo::Smoothness::least_bending);
  passo::Planner planner(smoother, inner_limits);
  MotionRecording recording(point_of(path.content().start), inner_limits.velocity);
  passo::MotionItem item;
  while (planner.next(item)) {
    if (recording.add(item)) continue;
    return Outcome<Motion>({error_of("plan.too-long", "path", 0, "the motion does not fit into memory",
                                     fmt::format("at most {} moves", Motion::Content::most_moves))});
  }
  return recording.motion();
}

}  // namespace passo::v1
