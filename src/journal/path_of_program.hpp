// PathOfProgram: the path of a program up to where a drive takes it over, as a chain of stages. Private to journal/.
//
// Each of the questions about a path (where a line begins, what was set up to a place, how far a part of it reaches)
// goes through the same stages as the run itself; otherwise the items would have other numbers.
//
//   text -> Interpreter -> PathBuilder -> PathSmoother -> BacklashTaker -> RewindablePath
#pragma once

#include <utility>

#include "passo/activity/stage_options.hpp"
#include "passo/base/tap.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/drive/backlash_options.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"

namespace passo {

class PathOfProgram {
 public:
  PathOfProgram(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options)
      : path_options_(path_options(machine, program.name(), options.start)),
        steps_(steps_from(machine, options.start)),
        interpreter_(std::move(program), options, diagnostics_),
        operations_(interpreter_),
        builder_(operations_, path_options_, diagnostics_),
        programmed_(builder_),
        smoother_(programmed_, smoothness(machine)),
        backlash_taker_(smoother_, backlash_options(steps_, true)),
        path_(backlash_taker_) {
    path_.keep();
  }

  // For watchers of the operations, and of the path before it is smoothed. Watchers are added before the first item.
  Tap<Operation>& operations() { return operations_; }
  Tap<PathItem>& programmed() { return programmed_; }
  RewindablePath& path() { return path_; }
  const StepOptions& steps() const { return steps_; }
  bool any_error() const { return diagnostics_.any_error(); }

 private:
  static StepOptions steps_from(const MachineDescription& machine, const Point& start) {
    StepOptions steps = step_options(machine);
    steps.start = start;
    return steps;
  }

  Diagnostics diagnostics_;
  PathOptions path_options_;
  StepOptions steps_;
  Interpreter interpreter_;
  Tap<Operation> operations_;
  PathBuilder builder_;
  Tap<PathItem> programmed_;
  PathSmoother smoother_;
  BacklashTaker backlash_taker_;
  RewindablePath path_;
};

}  // namespace passo
