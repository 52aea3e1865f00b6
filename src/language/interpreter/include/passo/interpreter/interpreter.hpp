// Interpreter: converts blocks into operations. It handles modal state, parameters, O-words and offsets, in LinuxCNC's
// dialect of RS274/NGC.
//
// Operations are pulled: each next() returns one operation. Errors in the program are collected. After an error, the
// interpreter continues with the next block if that makes sense, so that one pass finds all errors.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/active_modes.hpp"
#include "passo/interpreter/machine_results.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/parameter_file.hpp"
#include "passo/interpreter/program_hooks.hpp"
#include "passo/interpreter/settings_file.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

class BlockWatcher;
struct ToolChangePlan;

// The dialect of G-code: LinuxCNC's RS274/NGC, or the part of it that Grbl 1.1 accepts, with Grbl's error numbers in
// the diagnostics.
enum class Dialect : std::uint8_t { linuxcnc, grbl };

struct InterpreterOptions {
  Dialect dialect = Dialect::linuxcnc;
  bool block_delete = false;            // lines that start with '/' are skipped
  LengthUnits units = LengthUnits::mm;  // the units until G20 or G21
  Point start;                          // machine position at the start
  // The units of lengths in parameters (#5161 to #5390, #5401 to #5410) and in `parameters`.
  LengthUnits machine_units = LengthUnits::mm;
  ToolTable tools;                       // a table without a name: none was given
  SavedParameters parameters;            // the parameters saved after the last run
  std::vector<std::string> sub_folders;  // folders to search for subroutine files, after the program's own folder
  // Answers #<_ini[section]name>. Null: there are no settings.
  std::shared_ptr<const SettingsFile> settings;
  // The maximum number of passes of a loop (or of calls) without any action of the machine, before the program is
  // stopped with a diagnostic. Moves, dwells, stops and tool changes are actions; mode changes are not.
  std::uint64_t idle_passes = 1'000'000;
  // The maximum number of passes, calls and operations inside an outermost loop, call or cycle, before the program is
  // stopped with a diagnostic. Twenty million moves take a machine days (55 hours at 100 moves/s), but a check only
  // seconds.
  std::uint64_t repeated_steps = 20'000'000;
  // Selects how probe moves, inputs and #<_task> are evaluated. false: a preview as in LinuxCNC's `rs274`, where a
  // probe move stops 0.254 mm before its end and inputs are 0. true: a machine without inputs, where a probe move is
  // triggered at its end unless the machine's answers differ.
  bool on_machine = false;
  // Number of runs of a main program that ends with M99; 0: endless.
  std::uint64_t main_passes = 1;
  int spindles = 1;          // 1 to 8
  double orient_offset = 0;  // offset added to the angle of M19, degrees
  bool user_codes = false;   // M100 to M199 are allowed
  // Whether the program's lines arrive one by one, with push_line(). next() then returns false when no line is left,
  // and continues after the next push_line().
  bool open_ended = false;
  // What M6 does. Null: it waits for the operator.
  std::shared_ptr<const ToolChangePlan> tool_change;
  ProgramHooks hooks;  // only for a program with M2 or M30
  // Letters of further axes that the Grbl dialect accepts in addition to X, Y and Z, e.g. "AC".
  std::string more_grbl_axes;
};

class Interpreter final : public Source<Operation> {
 public:
  // `answers`: the results of the machine that runs the program. They are read when the operation after a probe move or
  // input is pulled. `diagnostics` and `answers` must outlive the interpreter.
  Interpreter(ProgramReader reader, const InterpreterOptions& options, Diagnostics& diagnostics,
              const MachineResults& answers = no_answers());
  ~Interpreter() override;

  [[nodiscard]] bool next(Operation& operation) override;

  // Adds a line to an open-ended program, whose reader is ProgramReader::from_lines(). Requires that next() has
  // returned false.
  void push_line(std::string_view text);
  // Returns whether the program has ended, with M2, M30 or a fatal error. The interpreter then accepts no more lines.
  bool ended() const;
  // keep() saves modes, offsets, parameters and the position after the lines read so far; roll_back() restores them, as
  // if later lines had not been read. Requires that next() has returned false.
  void keep();
  void roll_back();
  // Continues a program that has ended, with its modes.
  void reopen();
  // Returns the active motion code in tenths: 0 for G0, 382 for G38.2.
  int motion() const;
  void set_motion(int tenths);
  // Sets the machine position, replacing that at the end of the program so far. Modes and offsets are kept.
  void stand_at(const Point& machine);
  // Returns the modes and offsets after the lines read so far.
  ActiveModes modes() const;
  // Empty: the tool in the spindle was not measured by M6, or there is none.
  std::optional<ToolMeasurement> measured_tool() const;

  // Returns the parameters to save for the next run: InterpreterOptions::parameters with the program's changes.
  SavedParameters saved_parameters() const;
  // Returns the tool table including the changes by the program so far (G10 L1, L10, L11).
  const ToolTable& tools() const;
  // Sets the observer of executed blocks, e.g. for explain(). It must outlive the interpreter.
  void watch(BlockWatcher& watcher);

  // Returns the number of bytes of the main program read so far, for progress.
  std::uint64_t offset() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
