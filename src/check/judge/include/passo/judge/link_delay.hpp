// LinkDelay: the additional run time that a serial link to a board with a small queue causes, predicted before the run.
//
// The program is played over a virtual link to a virtual board with the queue size of the machine file, in virtual
// time, exactly as by `passo run --cut-cable-at`. A minute of machining takes some tenths of a second; with jerk
// limits, some seconds.
#pragma once

#include <functional>
#include <string>

#include "passo/activity/program.hpp"
#include "passo/base/result.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/link/board_session.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct LinkDelay {
  int held_items = 0;        // queue capacity of the board
  Seconds without{0};        // planned duration of motion and dwells
  Seconds over{0};           // duration until the board has played the last event
  int rests = 0;             // number of stops because the queue ran empty
  int slowdowns = 0;         // number of speed reductions because the stop ramp needs many queue items
  std::string trouble = {};  // reason why the program cannot finish over the link; empty: it finishes

  Seconds cost() const { return over > without ? over - without : Seconds(0); }
  double share() const { return without > Seconds(0) ? cost() / without : 0; }
};

// In virtual time a link may be slow, but a working board responds immediately.
inline constexpr LinkTimeouts virtual_line_care{.answer_within = Seconds(0.05), .patience = Seconds(3600)};

// Returns the planned duration of the motion and the dwells of a checked program, without a link.
Seconds planned_time(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                     const ProgramCheck& check);

// Returns whether the cost of a link can be computed: the machine file specifies the board's queue size, and the path
// does not depend on a probe.
bool has_line_cost(const MachineDescription& machine, const ProgramCheck& check);
// Plays a checked program over the link. `without` is its planned duration. `progress`, if set, is called from time to
// time with the completed fraction. The error: why the connection to the board fails; empty: the machine refuses the
// program, as it would in a run.
Result<LinkDelay, std::string> link_delay(ProgramReader program, const MachineDescription& machine,
                                          const InterpreterOptions& options, const ProgramCheck& check, Seconds without,
                                          const std::function<void(double)>& progress = {});

}  // namespace passo
