// LineCost: how much longer a program takes over a line to a board with few places, told before the run.
//
// The program is played over a virtual line to a virtual board with the places of the machine file, in virtual time:
// just what `passo run --cut-cable-at` does. A minute of machining takes some tenths of a second,
// with limits of jerk some seconds.
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

struct LineCost {
  int held_items = 0;        // the board's places
  Seconds without{0};        // motion and dwells as planned
  Seconds over{0};           // until the board has played the last event
  int rests = 0;             // for want of more
  int slowdowns = 0;         // where the speed is limited because the motion that brakes the machine has many items
  std::string trouble = {};  // why the program does not come to its end over the line; empty: it does

  Seconds cost() const { return over > without ? over - without : Seconds(0); }
  double share() const { return without > Seconds(0) ? cost() / without : 0; }
};

// A line in virtual time may be slow, but a board that lives answers at once.
inline constexpr LineCare virtual_line_care{.answer_within = Seconds(0.05), .patience = Seconds(3600)};

// The motion and the dwells of a program that was checked, as planned: the time without a line.
Seconds planned_time(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                     const ProgramCheck& check);

// Whether the cost of a line can be told: the machine file names the board's places, and no probe decides the way.
bool has_line_cost(const MachineDescription& machine, const ProgramCheck& check);
// Plays a program that was checked over the line. `without` is its planned time. `progress`, if any, is told now and
// then which share is done. The error: why the board cannot be greeted; empty: the machine refuses the program, as it
// would in a run.
Result<LineCost, std::string> line_cost(ProgramReader program, const MachineDescription& machine,
                                        const InterpreterOptions& options, const ProgramCheck& check, Seconds without,
                                        const std::function<void(double)>& progress = {});

}  // namespace passo
