// passo run and passo home on a machine with a Grbl 1.1 controller.
#pragma once

#include "commands.hpp"
#include "scheduled_changes.hpp"

#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// Returns whether such a machine supports what the arguments request. If not, shows a message.
bool suits_grbl(const RunArguments& arguments);
// Checks the program from the current machine position and with the machine's offsets, and streams it. Returns the exit
// code.
int run_on_grbl(const RunArguments& arguments, const MachineDescription& machine, ProgramReader program,
                InterpreterOptions options, ScheduledChanges& changes);
int home_grbl(const HomeArguments& arguments, const MachineDescription& machine);

}  // namespace passo
