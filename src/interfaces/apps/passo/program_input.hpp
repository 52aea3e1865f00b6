// Functions for every command that reads a program: opening it, and reporting its errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "named_files.hpp"
#include "terminal.hpp"

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

// Opens the program, or reports the reason on standard error.
std::optional<ProgramReader> streamed_program(const ProgramArguments& arguments);

// Return the interpreter's options, after reading the files named in the arguments. If a file is invalid, they report
// this on standard error and return nothing. interpreter_options() is for analysing the program, machine_options() for
// running it on the machine.
std::optional<InterpreterOptions> interpreter_options(const ProgramArguments& arguments);
std::optional<InterpreterOptions> machine_options(const ProgramArguments& arguments);

// Returns the tool table named by the arguments or the settings; empty: none.
std::string tool_table_file(const ProgramArguments& arguments, const InterpreterOptions& options);
// Returns the parameter file named by the arguments or the settings; empty: none.
std::string parameter_file(const ProgramArguments& arguments, const InterpreterOptions& options);

// Returns the files named by the arguments or the settings, as files that are read.
NamedFiles files_of(const ProgramArguments& arguments, const InterpreterOptions& options);

// Writes all findings to standard error, in colour on a terminal.
void show(const Diagnostics& diagnostics);
// Does the same; findings without a file name belong to this file.
void show(const Diagnostics& diagnostics, const std::string& file);

// Shows findings on standard error as soon as they are found, while a stage is still processing the program.
class FindingsDisplay {
 public:
  explicit FindingsDisplay(const Diagnostics& findings) : findings_(findings) {}
  // Shows new findings. Cheap if there are none.
  void update() {
    if (has_news()) show_new();
  }
  bool has_news() const { return findings_.all().size() != shown_; }
  // Shows the remaining findings, and the number of errors.
  void finish();

 private:
  void show_new();

  const Diagnostics& findings_;
  std::size_t shown_ = 0;
  std::size_t shown_text_ = 0;  // number of characters shown
};

// Reports on standard error why the command ends. Returns the given exit code.
int fail(ExitCode code, const std::string& message);
// Reports information on standard error that requires no action.
void note(const std::string& words);
// Prints a command's summary on standard output.
void say(const std::string& text);

// While it exists, what the functions above would show is kept instead. For a command that runs others.
class KeptMessages {
 public:
  KeptMessages();
  ~KeptMessages();
  KeptMessages(const KeptMessages&) = delete;
  KeptMessages& operator=(const KeptMessages&) = delete;

  std::vector<Diagnostic> findings = {};
  std::vector<std::string> failures = {};
  std::vector<std::string> notes = {};
  std::string said = {};

 private:
  KeptMessages* outer_;
};

// While it exists, warnings and notes are shown and also recorded, for a summary as JSON.
class RecordedMessages {
 public:
  RecordedMessages();
  ~RecordedMessages();
  RecordedMessages(const RecordedMessages&) = delete;
  RecordedMessages& operator=(const RecordedMessages&) = delete;

  // Null: nothing is recorded, also while messages are kept.
  static const RecordedMessages* current();

  std::vector<Diagnostic> warnings = {};
  std::vector<std::string> notes = {};

 private:
  RecordedMessages* outer_;
};

// Flushes standard output. Returns exit_done, or the exit code that the command should return. If the reader has closed
// the pipe, as `head` does, this is not an error.
int flush_output();

}  // namespace passo
