// What every command does with a program: open it, and say what is wrong with it.
#pragma once

#include <optional>

#include "commands.hpp"

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

// Opens the program, or says on standard error why not.
std::optional<ProgramReader> open_program(const ProgramArguments& arguments);

// For a look at what the program means, and for a run on the machine.
InterpreterOptions interpreter_options(const ProgramArguments& arguments);
InterpreterOptions machine_options(const ProgramArguments& arguments);

// Writes all findings to standard error, in colour on a terminal.
void show(const Diagnostics& diagnostics);

bool is_terminal(int descriptor);

}  // namespace passo
