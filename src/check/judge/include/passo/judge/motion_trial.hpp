// prove_motion(): plays a program on a virtual machine and measures the motion of the board's events.
#pragma once

#include <functional>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/proof/motion_proof.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// Optional receivers of the path and the motion. Empty functions: none.
struct TrialWatchers {
  std::function<void(const PathItem&)> path = {};
  std::function<void(const MotionItem&)> motion = {};
  std::function<void(double share)> progress = {};  // called from time to time with the completed fraction
};

// `program` must have been checked. `nominal`: its duration at the programmed feed rates, for the progress. Errors that
// are found only during the run are added to `findings`.
MotionProof prove_motion(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                         Seconds nominal, Diagnostics& findings, const TrialWatchers& watchers = {});

}  // namespace passo
