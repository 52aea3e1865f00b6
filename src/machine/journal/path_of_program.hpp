// PathOfProgram: the path of a program up to the drive. Private to journal/.
//
//   ProgramStages -> BacklashCompensator -> RewindablePath
#pragma once

#include <utility>
#include <vector>

#include "passo/activity/program_stages.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/drive/backlash_options.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/interpreter/machine_results.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

class PathOfProgram {
 public:
  // Assumes that probe moves make contact at their ends, as a check does.
  PathOfProgram(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options)
      : PathOfProgram(std::move(program), machine, options, no_answers(), {}) {}
  // Uses `known`, the results of a run's first probe moves. After the first probe move without a known result, the path
  // is meaningless.
  PathOfProgram(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const std::vector<ProbeOutcome>& known)
      : PathOfProgram(std::move(program), machine, options, nothing_found(), known) {}

  // Taps for observers of the operations, and of the path before smoothing. Add observers before the first item.
  Tap<Operation>& operations() { return stages_.operations(); }
  Tap<PathItem>& programmed() { return stages_.path(); }
  RewindablePath& path() { return path_; }
  const StepOptions& steps() const { return steps_; }
  bool any_error() const { return diagnostics_.any_error(); }
  // Returns true if the result of the newest probe move is known.
  bool knows_last_probe() const { return stages_.answers().knows_last(); }

 private:
  PathOfProgram(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                const MachineResults& answers, const std::vector<ProbeOutcome>& known)
      : steps_(steps_from(machine, options.start)),
        stages_(std::move(program), machine, options, answers, diagnostics_, known),
        backlash_compensator_(stages_.smooth_path(), backlash_options(steps_, smoothness(machine), true)),
        path_(backlash_compensator_) {
    path_.keep();
  }
  static StepOptions steps_from(const MachineDescription& machine, const Point& start) {
    StepOptions steps = step_options(machine);
    steps.start = start;
    return steps;
  }
  static const MachineResults& nothing_found() {
    static const StoredResults book;
    return book;
  }

  Diagnostics diagnostics_;
  StepOptions steps_;
  ProgramStages stages_;
  BacklashCompensator backlash_compensator_;
  RewindablePath path_;
};

}  // namespace passo
