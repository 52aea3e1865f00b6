// passo run --from-line: shows the way back onto the path of a program, and asks.
#pragma once

#include <optional>

#include "commands.hpp"

#include "passo/journal/reentry.hpp"

namespace passo {

// Empty, with `code` and a message: there is no such way, or nobody has agreed to it. `options`: where the machine will
// stand when the program begins.
std::optional<Reentry> way_to_line(const RunArguments& arguments, const ProgramReader& program,
                                   const MachineDescription& machine, const InterpreterOptions& options, int& code);

}  // namespace passo
