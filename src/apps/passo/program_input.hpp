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

// What the interpreter needs, with the files that the arguments name read; says on standard error what is wrong with
// them. For a look at what the program means, and for a run on the machine.
std::optional<InterpreterOptions> interpreter_options(const ProgramArguments& arguments);
std::optional<InterpreterOptions> machine_options(const ProgramArguments& arguments);

// The tool table that the arguments or the settings name; empty: none.
std::string tool_table_file(const ProgramArguments& arguments, const InterpreterOptions& options);
// The parameter file that the arguments or the settings name; empty: none.
std::string parameter_file(const ProgramArguments& arguments, const InterpreterOptions& options);

// Writes all findings to standard error, in colour on a terminal.
void show(const Diagnostics& diagnostics);

// Says on standard error why the command ends here; the exit code that was given.
int fail(ExitCode code, const std::string& message);

bool is_terminal(int descriptor);

}  // namespace passo
