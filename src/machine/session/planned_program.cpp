#include "passo/session/planned_program.hpp"

#include <utility>
#include <variant>

#include "passo/activity/stage_options.hpp"
#include "passo/drive/backlash_options.hpp"
#include "passo/interpreter/machine_results.hpp"

namespace passo {
namespace {

BacklashOptions backlash_from(const MachineDescription& machine, const Point& start) {
  StepOptions steps = step_options(machine);
  steps.start = start;
  return backlash_options(steps, smoothness(machine), false);
}

}  // namespace

PlannedProgram::PlannedProgram(ProgramReader program, const MachineDescription& machine,
                               const InterpreterOptions& options, const ProgramCheck& check,
                               const MotionFactors& factors)
    : check_(check),
      activity_(std::move(program), machine, options, no_answers(), findings_, check.nominal_time),
      path_with_rests_(activity_, backlash_from(machine, options.start)),
      planner_(path_with_rests_, motion_limits(machine)) {
  activity_.path().watch([this](const PathItem& item) { segments_ += std::holds_alternative<Segment>(item) ? 1 : 0; });
  planner_.set_feed_override(factors.feed);
  planner_.set_rapid_override(factors.rapids);
}

bool PlannedProgram::next(MotionItem& item) {
  return (!check_.probes || segments_ < check_.moves) && planner_.next(item);
}

}  // namespace passo
