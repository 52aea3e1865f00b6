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

// What else gets the path and the motion. Empty functions: nobody.
struct TrialWatchers {
  std::function<void(const PathItem&)> path = {};
  std::function<void(const MotionItem&)> motion = {};
  std::function<void(double share)> progress = {};  // is told now and then which share is done
};

// `program` was checked. `nominal`: its time at the programmed speeds, for the progress. What is found only in the run
// goes to `findings`.
MotionProof prove_motion(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                         Seconds nominal, Diagnostics& findings, const TrialWatchers& watchers = {});

}  // namespace passo
