// check_for_grbl(): checks a program for a Grbl machine, with the machine's offsets, before anything moves.
#pragma once

#include <functional>
#include <string>

#include "passo/activity/program.hpp"
#include "passo/base/result.hpp"
#include "passo/sender/grbl_machine.hpp"
#include "passo/sender/grbl_target.hpp"

namespace passo {

// Sets the initial offsets of a program to those of the machine, on all axes: G54 to G59.3 and G92. The program begins
// in G54.
void set_offsets(InterpreterOptions& options, const GrblMachine& machine);

// Judges the path items of one program, in their order: the error is a clause that says what the board cannot do.
using GrblPathJudge = std::function<Status<std::string>(const PathItem&)>;
GrblPathJudge grbl_path_judge(const GrblTarget& target);

// Checks a program as for our boards, and whether a Grbl machine supports it: what it does not support is an error
// "grbl.cannot" at its line, once for each reason. Observers, if set, receive each path item and each operation.
ProgramCheck check_for_grbl(const ProgramReader& program, const MachineDescription& machine,
                            const InterpreterOptions& options, const GrblTarget& target, Diagnostics& findings,
                            const std::function<void(const PathItem&)>& watch_path = {},
                            const std::function<void(const Operation&)>& watch_operations = {});

}  // namespace passo
