// Interpreter: blocks -> operations. Modal state, parameters, O-words, offsets; RS274/NGC in LinuxCNC's dialect.
//
// Pulled: each next() gives one operation. Errors in the program are collected; after an error in a block the
// interpreter goes on with the next one where that makes sense, so that one pass finds them all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/machine_answers.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/parameter_file.hpp"
#include "passo/interpreter/settings_file.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

class BlockWatcher;

// Whose G-code: LinuxCNC's RS274/NGC, or the part of it that grbl 1.1 accepts, with grbl's numbers in the diagnostics.
enum class Dialect : std::uint8_t { linuxcnc, grbl };

struct InterpreterOptions {
  Dialect dialect = Dialect::linuxcnc;
  bool block_delete = false;            // lines that start with '/' are skipped
  LengthUnits units = LengthUnits::mm;  // before the program says G20 or G21
  Point start;                          // machine position at the start
  // Of lengths in parameters (#5161 to #5390, #5401 to #5410) and in `parameters`.
  LengthUnits machine_units = LengthUnits::mm;
  ToolTable tools;                       // without a name: nobody gave one
  SavedParameters parameters;            // what was saved after the last run
  std::vector<std::string> sub_folders;  // where subs in files are looked for, after the program's own folder
  // What #<_ini[section]name> asks; null: nothing.
  std::shared_ptr<const SettingsFile> settings;
  // Passes of a loop without any operation between, before it is stopped with a diagnostic.
  std::uint64_t idle_passes = 1'000'000;
  // Who answers when the program asks the machine (probe, inputs, #<_task>): a preview as LinuxCNC's `rs274` does,
  // where a probe move ends 0.254 mm before its end and inputs are 0; or a machine without inputs, where a probe move
  // is touched at its very end if the machine's answers do not say otherwise.
  bool on_machine = false;
  // How often a main program that ends with M99 runs; 0: without end.
  std::uint64_t main_passes = 1;
  int spindles = 1;          // 1 to 8
  double orient_offset = 0;  // degrees that M19 adds
  bool user_codes = false;   // M100 to M199 are allowed
};

class Interpreter final : public Source<Operation> {
 public:
  // `answers`: of a machine that runs the program now. Looked at when an operation after the question is asked for.
  // Both outlive the interpreter.
  Interpreter(ProgramReader reader, const InterpreterOptions& options, Diagnostics& diagnostics,
              const MachineAnswers& answers = no_answers());
  ~Interpreter() override;

  [[nodiscard]] bool next(Operation& operation) override;

  // What is to be saved for the next run: InterpreterOptions::parameters with what the program changed.
  SavedParameters saved_parameters() const;
  // The tools as the program has left them so far (G10 L1, L10, L11).
  const ToolTable& tools() const;
  // What this module's explain() sees blocks with; borrowed.
  void watch(BlockWatcher& watcher);

  // Bytes of the program read so far in its main line, for progress.
  std::uint64_t offset() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
