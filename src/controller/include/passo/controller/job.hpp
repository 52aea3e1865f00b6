// Job: the composition root. Owns the stages of the street, in order, and pulls the last one.
//
// A job runs twice over its program. The checking pass interprets it and builds the path, so that everything that is
// wrong with it is said before anything turns, and so that the time that is left can be told. The second pass runs it.
#pragma once

#include <cstdint>
#include <string>

#include "passo/base/source.hpp"
#include "passo/controller/tap.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/link/in_process_link.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

// What a program amounts to before it is planned.
struct ProgramCheck {
  bool good = false;        // no error: it may run
  Seconds nominal_time{0};  // at the programmed speeds, without ramps: good for progress only
  std::uint64_t moves = 0;
  bool tools_change = false;  // the program sets some in the tool table
};

// Interprets the whole program and builds its path; what is wrong is in `diagnostics`.
ProgramCheck check_program(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                           Diagnostics& diagnostics);

class Job {
 public:
  // `diagnostics` gets what the second pass still finds (nothing, after a good check).
  Job(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
      Diagnostics& diagnostics);

  // Plays a little more of the job (one board segment). False at the end, with everything at rest, and when the link
  // has an error.
  [[nodiscard]] bool advance();

  // Who wants to watch, before the first advance().
  Tap<PathItem>& path() { return watched_path_; }
  Tap<MotionItem>& motion() { return watched_motion_; }
  Tap<BoardItem>& board() { return watched_board_; }
  VirtualMachine& machine() { return machine_; }
  const InProcessLink& link() const { return link_; }
  const Frame& frame() const { return path_builder_.frame(); }
  SavedParameters saved_parameters() const { return interpreter_.saved_parameters(); }
  const ToolTable& tools() const { return interpreter_.tools(); }

  // The nominal time of what has been planned so far.
  Seconds nominal_time() const { return nominal_time_; }

 private:
  PathOptions path_options_;
  MotionLimits limits_;

  // The street.
  Interpreter interpreter_;   // text -> blocks -> operations
  PathBuilder path_builder_;  // operations -> segments
  Tap<PathItem> watched_path_;
  PathSmoother smoother_;  // corners -> curves within the tolerance
  Planner planner_;        // segments -> phases
  Tap<MotionItem> watched_motion_;
  StepGenerator step_generator_;  // phases -> board segments
  Tap<BoardItem> watched_board_;
  VirtualMachine machine_;  // what is at the other end of the wire
  InProcessLink link_;      // board segments -> wire

  BoardItem item_;
  Seconds nominal_time_{0};
};

}  // namespace passo
