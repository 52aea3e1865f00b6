#include "passo/sender/grbl_motion.hpp"

#include <utility>
#include <variant>

namespace passo {
namespace {

constexpr Seconds shortest_rest{0.005};  // shorter ones do not count

bool covers(const PlannedMove& move, const GrblBlock& block) {
  const Curve& curve = move.segment.curve;
  return curve.start() == block.start && curve.end() == block.end;
}

}  // namespace

GrblMotion::GrblMotion(const ProgramReader& program, const MachineDescription& machine,
                       const InterpreterOptions& options, const GrblLimits& limits, const GrblLine& line,
                       const GrblTarget& target)
    : checker_(program.again(), machine, options, unheard_),
      code_(target),
      forecast_(limits, line, options.start, target) {
  checker_.watch([this](const PathItem& item) { add(item); });
  forecast_.hear([this](const GrblPhase& phase) { add(phase); });
}

void GrblMotion::watch_operations(std::function<void(const Operation&)> watcher) {
  checker_.watch_operations(std::move(watcher));
}

bool GrblMotion::next(MotionItem& item) {
  while (ready_.empty()) {
    if (ended_) return false;
    ended_ = checker_.go_on(1);
    if (!ended_) continue;
    result_ = forecast_.finish();
    end_move();
  }
  item = std::move(ready_.front());
  ready_.pop_front();
  return true;
}

void GrblMotion::add(const PathItem& item) {
  if (path_watcher_) path_watcher_(item);
  lines_.clear();
  if (!code_.write(item, lines_)) return;  // the check has reported it
  const std::uint32_t source = GrblCode::source_line(item);
  for (const std::string& line : lines_) forecast_.add(line, source);
  const auto* action = std::get_if<Action>(&item);
  if (action == nullptr) return;
  end_move();
  ready_.emplace_back(*action);
  now_ = now_ + action->dwell;
}

void GrblMotion::add(const GrblPhase& phase) {
  if (move_ && (!covers(*move_, phase.block) || move_->phase_count == PlannedMove::most_phases)) end_move();
  if (!move_ && phase.begun - now_ > shortest_rest) rest(phase.begun - now_);
  if (!move_) {
    const GrblBlock& block = phase.block;
    move_.emplace();
    move_->begin_on({.curve = Curve::line(block.start, block.end),
                     .speed = block.feed * block.scale,
                     .rapid = block.rapid,
                     .source = {.line = block.source}});
  }
  move_->add(
      {.duration = phase.duration, .start = phase.from, .velocity = phase.speed, .acceleration = phase.acceleration});
  now_ = phase.begun + phase.duration;
  move_->to = phase.end();
}

void GrblMotion::end_move() {
  if (!move_) return;
  ready_.emplace_back(std::move(*move_));
  move_.reset();
}

void GrblMotion::rest(Seconds time) {
  ready_.emplace_back(Action{.kind = Action::Kind::dwell, .dwell = time});
  now_ = now_ + time;
}

}  // namespace passo
