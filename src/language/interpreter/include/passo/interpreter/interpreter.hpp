// Interpreter: blocks -> operations. Modal state, parameters, O-words, offsets; RS274/NGC in LinuxCNC's dialect.
//
// Operations are pulled: each next() gives one operation. Errors in the program are collected. After an error in a
// block the interpreter goes on with the next block where that makes sense, so one pass finds all errors.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/machine_answers.hpp"
#include "passo/interpreter/modes_in_force.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/parameter_file.hpp"
#include "passo/interpreter/settings_file.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

class BlockWatcher;

// The dialect of G-code: LinuxCNC's RS274/NGC, or the part of it that grbl 1.1 accepts, with grbl's numbers in the
// diagnostics.
enum class Dialect : std::uint8_t { linuxcnc, grbl };

struct InterpreterOptions {
  Dialect dialect = Dialect::linuxcnc;
  bool block_delete = false;            // lines that start with '/' are skipped
  LengthUnits units = LengthUnits::mm;  // the units until the program says G20 or G21
  Point start;                          // machine position at the start
  // The units of lengths in parameters (#5161 to #5390, #5401 to #5410) and in `parameters`.
  LengthUnits machine_units = LengthUnits::mm;
  ToolTable tools;                       // no name: nobody gave a tool table
  SavedParameters parameters;            // the parameters saved after the last run
  std::vector<std::string> sub_folders;  // folders to search for subs in files, after the program's own folder
  // Answers #<_ini[section]name>. Null: there are no settings.
  std::shared_ptr<const SettingsFile> settings;
  // How many passes in which the machine does nothing a loop may make (how many such calls a program may make) before
  // the program is stopped with a diagnostic. Moves, waits, stops and tool changes are something; modes are not.
  std::uint64_t idle_passes = 1'000'000;
  // How many passes, calls and operations an outermost loop, call or cycle may come to, with all that is inside, before
  // the program is stopped with a diagnostic. Twenty million moves take a machine days: 100 moves a second are 55
  // hours. The check comes to them in seconds.
  std::uint64_t repeated_steps = 20'000'000;
  // Who answers when the program asks the machine (probe, inputs, #<_task>). A preview answers as LinuxCNC's `rs274`
  // does: a probe move ends 0.254 mm before its end, and inputs are 0. A machine has no inputs, and a probe move is
  // touched at its very end unless the machine's answers say otherwise.
  bool on_machine = false;
  // How often a main program that ends with M99 runs; 0: without end.
  std::uint64_t main_passes = 1;
  int spindles = 1;          // 1 to 8
  double orient_offset = 0;  // degrees that M19 adds
  bool user_codes = false;   // M100 to M199 are allowed
  // True: the program's lines come one by one, with push_line(). next() then returns false where no line is left, and
  // goes on after the next push_line().
  bool open_ended = false;
  // Letters of axes beside X, Y and Z, as "AC". The dialect of grbl takes these too.
  std::string more_grbl_axes;
};

class Interpreter final : public Source<Operation> {
 public:
  // `answers`: the answers of a machine that runs the program now. They are read when an operation after the question
  // is pulled. `diagnostics` and `answers` outlive the interpreter.
  Interpreter(ProgramReader reader, const InterpreterOptions& options, Diagnostics& diagnostics,
              const MachineAnswers& answers = no_answers());
  ~Interpreter() override;

  [[nodiscard]] bool next(Operation& operation) override;

  // Only for an open-ended program, whose reader is ProgramReader::from_lines(). Call when next() has returned false.
  void push_line(std::string_view text);
  // True: the program has ended, with M2, M30 or an error that ends programs. The interpreter takes no more lines.
  bool ended() const;
  // Notes modes, offsets, parameters and the place, which are those of the lines so far; and goes back to them, as if
  // the lines since had not come. Call when next() has returned false.
  void keep();
  void roll_back();
  // A program that has ended goes on, with its modes.
  void reopen();
  // The motion code in force, as tenths: 0 for G0, 382 for G38.2.
  int motion() const;
  void set_motion(int tenths);
  // Says that the machine stands somewhere else than where the program has left it. Modes and offsets stay.
  void stand_at(const Point& machine);
  // The modes and offsets after the lines read so far.
  ModesInForce modes() const;

  // The parameters to save for the next run: InterpreterOptions::parameters with the program's changes.
  SavedParameters saved_parameters() const;
  // The tools as the program has left them so far (G10 L1, L10, L11).
  const ToolTable& tools() const;
  // The watcher with which this module's explain() sees blocks. The interpreter only borrows it.
  void watch(BlockWatcher& watcher);

  // Bytes of the program read so far in its main line, for progress.
  std::uint64_t offset() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
