// passo run --from-line: shows the reentry move to the path of a program, and asks for confirmation.
#pragma once

#include <optional>

#include "commands.hpp"

#include "passo/journal/reentry.hpp"

namespace passo {

// Returns nothing, with `code` and a message, if there is no such move, or if the user has not confirmed it. `options`:
// the machine position at the start of the program.
std::optional<Reentry> way_to_line(const RunArguments& arguments, const ProgramReader& program,
                                   const MachineDescription& machine, const InterpreterOptions& options, int& code);

}  // namespace passo
