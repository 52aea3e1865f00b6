// GrblProgram: a program as the lines for a Grbl machine, with the program's stops between them.
//
// Position in the pipeline: in front of GrblSender. The program is interpreted and its path built as for our boards,
// with the offsets of the Grbl machine; GrblCode converts the path to lines.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "passo/activity/operator_messages.hpp"
#include "passo/activity/program.hpp"
#include "passo/journal/reentry.hpp"
#include "passo/sender/grbl_code.hpp"
#include "passo/sender/grbl_machine.hpp"
#include "passo/session/machine_status.hpp"

namespace passo {

// Sets the initial offsets of a program to those of the machine, on all axes: G54 to G59.3 and G92. The program begins
// in G54.
void set_offsets(InterpreterOptions& options, const GrblMachine& machine);

// Checks a program as for our boards, and whether a Grbl machine supports it: what it does not support is an error
// "grbl.cannot" at its line, once for each reason. Observers, if set, receive each path item and each operation.
ProgramCheck check_for_grbl(const ProgramReader& program, const MachineDescription& machine,
                            const InterpreterOptions& options, const GrblTarget& target, Diagnostics& findings,
                            const std::function<void(const PathItem&)>& watch_path = {},
                            const std::function<void(const Operation&)>& watch_operations = {});

class GrblProgram {
 public:
  struct Line {
    std::string text;
    std::uint32_t line = 0;  // line of the program
    Seconds silence{0};      // how long the machine may not respond, because of a dwell
  };

  // The program must have passed check_for_grbl(). `waits`: it waits at its stops and tool changes. `machine` must
  // outlive this object.
  GrblProgram(const ProgramReader& program, const MachineDescription& machine, const InterpreterOptions& options,
              const GrblTarget& target, bool waits);

  // Begins at a line, after the reentry move.
  void begin_at(const Reentry& way);
  // Sets a listener, which receives each operation of the program from its start position on.
  void hear(std::function<void(const Operation&)> listener) { listener_ = std::move(listener); }
  // Returns the next line. Empty: the program has ended, or waits at a stop. The last line, and the last one before a
  // stop, are acknowledged only when all motion is complete.
  std::optional<Line> next();
  // The stop at which the machine waits until go_on() is called.
  const std::optional<OperatorWait>& stop() const { return stop_; }
  void go_on() { stop_.reset(); }
  bool ended() const { return ended_ && ready_.empty(); }
  // Returns the nominal time of the program read so far.
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
  OperatorMessages words_;
  std::deque<Ready> ready_;
  std::optional<OperatorWait> stop_;
  std::uint32_t from_line_ = 0;
  bool ended_ = false;
};

}  // namespace passo
