// What every command does with a program: opens the program, and reports what is wrong with it.
#pragma once

#include <optional>

#include "commands.hpp"
#include "named_files.hpp"
#include "terminal.hpp"

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

// Opens the program, or reports the reason on standard error.
std::optional<ProgramReader> open_program(const ProgramArguments& arguments);

// The interpreter's options, after reading the files that the arguments name. If a file is wrong, reports that on
// standard error and returns nothing. interpreter_options() is for finding out what the program means,
// machine_options() for a run on the machine.
std::optional<InterpreterOptions> interpreter_options(const ProgramArguments& arguments);
std::optional<InterpreterOptions> machine_options(const ProgramArguments& arguments);

// The tool table that the arguments or the settings name; empty: none.
std::string tool_table_file(const ProgramArguments& arguments, const InterpreterOptions& options);
// The parameter file that the arguments or the settings name; empty: none.
std::string parameter_file(const ProgramArguments& arguments, const InterpreterOptions& options);

// The files that the arguments name or that the settings name, as files that are read.
NamedFiles files_of(const ProgramArguments& arguments, const InterpreterOptions& options);

// Writes all findings to standard error, in colour on a terminal.
void show(const Diagnostics& diagnostics);
// The same, where findings that name no file are of this one.
void show(const Diagnostics& diagnostics, const std::string& file);

// Shows findings on standard error as soon as they are found, where a stage still works on the program.
class FindingsDisplay {
 public:
  explicit FindingsDisplay(const Diagnostics& findings) : findings_(findings) {}
  // Shows what is new. Cheap where nothing is.
  void update() {
    if (has_news()) show_new();
  }
  bool has_news() const { return findings_.all().size() != shown_; }
  // Shows the rest, and the number of errors.
  void finish();

 private:
  void show_new();

  const Diagnostics& findings_;
  std::size_t shown_ = 0;
  std::size_t shown_text_ = 0;  // characters
};

// Reports on standard error why the command ends here. Returns the given exit code.
int fail(ExitCode code, const std::string& message);
// Reports on standard error something that the user should know and need not heed.
void note(const std::string& words);
// Hands what was printed to the reader of standard output. Returns exit_done, or what the command should return. A
// reader that has gone away, as `head` does, has seen enough: that is no error to report.
int flush_output();

}  // namespace passo
