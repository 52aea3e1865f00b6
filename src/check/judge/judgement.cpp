#include "passo/judge/judgement.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/base/relay.hpp"
#include "passo/path/hand_tool_change.hpp"
#include "passo/report/summary_builder.hpp"

namespace passo {
namespace {

// The track wants the load of each phase, and the survey tells that of the last move. So the move comes in pieces.
// Returns the greatest load.
double watch_in_phases(const PlannedMove& move, MarginSurvey& survey, LoadTrack& track) {
  double most = 0;
  PlannedMove piece;
  piece.begin_on(move.segment);
  piece.phase_count = 1;
  for (const Phase& phase : move) {
    piece.phases[0] = phase;
    piece.to = &phase + 1 == move.end() ? move.to : (&phase + 1)->start;
    survey.watch(piece);
    most = std::max(most, survey.last_load());
    track.add(phase.duration, piece.to - phase.start, survey.last_load(), move.segment.source.line);
  }
  return most;
}

// The work's zero.
Point zero_of(const MotionItem& item) {
  const auto* move = std::get_if<PlannedMove>(&item);
  return move != nullptr ? move->segment.work_zero : Point();
}

// The loads of the motors, and what the watchers want of them.
void watch_loads(const MotionItem& item, MarginSurvey& survey, const JudgeWatchers& watchers) {
  const auto* move = std::get_if<PlannedMove>(&item);
  double load = 0;
  if (move != nullptr && watchers.loads != nullptr) survey.set_cut(watchers.loads->of(*move));
  if (move != nullptr && watchers.track != nullptr) {
    load = watch_in_phases(*move, survey, *watchers.track);
  } else {
    survey.watch(item);
    load = survey.last_load();
  }
  if (move != nullptr && watchers.lines != nullptr) watchers.lines->add(move->segment.source.line, load);
  if (watchers.path == nullptr) return;
  watchers.path->load_of_next(load);
  watchers.path->watch(item, zero_of(item));
}

}  // namespace

void LineTorques::add(std::uint32_t line, double load) {
  if (line >= loads_.size()) loads_.resize(line + 1, -1.0F);
  loads_[line] = std::max(loads_[line], static_cast<float>(load));
}

std::string LineTorques::text() const {
  std::string text = "line,load\n";
  for (std::size_t line = 0; line < loads_.size(); ++line) {
    if (loads_[line] >= 0) fmt::format_to(std::back_inserter(text), "{},{:.3f}\n", line, loads_[line]);
  }
  return text;
}

Judgement judge(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const ProgramCheck& check, const JudgeWatchers& watchers, const std::function<void(double)>& progress,
                const MotionFactors& factors) {
  PlannedProgram planned(std::move(program), machine, options, check, factors);
  return judge(planned, machine, check.nominal_time, watchers, progress);
}

Judgement judge(ProgramMotion& motion, const MachineDescription& machine, Seconds whole, const JudgeWatchers& watchers,
                const std::function<void(double)>& progress) {
  std::vector<Axis> axes;
  AxisSet axis_set;
  for (const AxisDescription& axis : machine.axes) {
    axes.push_back(axis.axis);
    axis_set.add(axis.axis);
  }
  SummaryBuilder builder(axes);
  MarginSurvey survey(surveyed_motors(machine), step_grid(machine));
  SpeedSurvey speeds(motion_limits(machine), axis_set);
  Judgement judged;
  motion.watch_operations([&](const Operation& operation) { builder.watch_operation(operation); });
  motion.watch_path([&](const PathItem& item) { builder.watch_path(item); });
  constexpr unsigned items_between_looks = 1024;
  unsigned items = 0;
  const auto plan = [&](MotionItem& item) {
    if (!motion.next(item)) return false;
    builder.add_up(item);
    if (const auto* action = std::get_if<Action>(&item)) {
      judged.tool_changes += changes_tool(*action) ? 1 : 0;
    }
    if (progress && ++items % items_between_looks == 0) progress(motion.nominal_time() / whole);
    return true;
  };
  const auto measure = [&](const MotionItem& item) {
    if (const auto* move = std::get_if<PlannedMove>(&item)) speeds.watch(*move);
    builder.measure(item, zero_of(item));
  };
  Relay<MotionItem>({measure, [&](const MotionItem& item) { watch_loads(item, survey, watchers); }}).run(plan);
  judged.summary = builder.summary();
  judged.speed = speeds.report();
  judged.margin = survey.verdict();
  judged.knows_motors = !judged.margin.axes.empty();
  return judged;
}

}  // namespace passo
