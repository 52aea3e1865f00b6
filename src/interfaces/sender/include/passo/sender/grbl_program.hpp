// GrblProgram: a program as the lines that a machine which speaks Grbl gets, with the program's stops between them.
//
// Place on the street: in front of GrblSender. The program is interpreted and its path built as for our boards, with
// the offsets of the Grbl machine; GrblCode writes the path.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "passo/activity/program.hpp"
#include "passo/activity/wait_words.hpp"
#include "passo/journal/reentry.hpp"
#include "passo/sender/grbl_code.hpp"
#include "passo/sender/grbl_machine.hpp"
#include "passo/session/machine_status.hpp"

namespace passo {

// The machine's own offsets become those with which a program begins: G54 to G59 and G92. It begins in G54.
void set_offsets(InterpreterOptions& options, const GrblMachine& machine);
// Where the zero of G54 lies with G92, machine coordinates, mm.
Point first_work_zero(const GrblMachine& machine);

// Checks a program as for our boards, and whether a Grbl machine can do it: what it cannot is an error "grbl.cannot" at
// its line, once for each reason. `zero`: as for GrblCode.
ProgramCheck check_for_grbl(const ProgramReader& program, const MachineDescription& machine,
                            const InterpreterOptions& options, const Point& zero, Diagnostics& findings);

class GrblProgram {
 public:
  struct Line {
    std::string text;
    std::uint32_t line = 0;  // of the program
    Seconds silence{0};      // for so long the machine may be silent: a dwell
  };

  // A program that check_for_grbl() has found good. `waits`: it waits at its stops and tool changes. `machine` outlives
  // this.
  GrblProgram(const ProgramReader& program, const MachineDescription& machine, const InterpreterOptions& options,
              const Point& zero, bool waits);

  // Begins at a line, after the way there.
  void begin_at(const Reentry& way);
  // `listener` gets each operation of the program from where it begins.
  void hear(std::function<void(const Operation&)> listener) { listener_ = std::move(listener); }
  // The next line. Empty: the program has ended, or waits at a stop. The last line, and the last one before a stop, are
  // answered when all motion is done.
  std::optional<Line> next();
  // The machine is to rest here until somebody goes on.
  const std::optional<OperatorWait>& stop() const { return stop_; }
  void go_on() { stop_.reset(); }
  bool ended() const { return ended_ && ready_.empty(); }
  // Of what was read so far.
  Seconds nominal_time() const { return checker_.result().nominal_time; }

 private:
  struct Ready {
    Line line;
    std::optional<OperatorWait> stop = {};
  };

  void add(const PathItem& item);
  bool reaches(const PathItem& item);
  void write(const PathItem& item);

  GrblCode code_;
  Diagnostics unheard_;
  ProgramChecker checker_;
  std::function<void(const Operation&)> listener_;
  bool waits_;
  WaitWords words_;
  std::deque<Ready> ready_;
  std::optional<OperatorWait> stop_;
  std::uint32_t from_line_ = 0;
  bool ended_ = false;
};

}  // namespace passo
