// The options of the commands that read a program (run, check, canon, explain), and those common to all of them.
#pragma once

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

void add_program(CLI::App& command, ProgramArguments& arguments,
                 const char* what = "G-code file; - reads standard input");
// Adds the options for the machine-specific files on which a program depends. With `letters`, adds LinuxCNC's short
// names, too. Some commands cannot have these names: `run` has its own -t.
void add_files(CLI::App& command, ProgramArguments& arguments, bool letters);

void add_run_options(CLI::App& command, RunArguments& arguments);
void add_check_options(CLI::App& command, CheckArguments& arguments);
void add_canon_options(CLI::App& command, CanonArguments& arguments);
void add_explain_options(CLI::App& command, ExplainArguments& arguments);

}  // namespace passo
