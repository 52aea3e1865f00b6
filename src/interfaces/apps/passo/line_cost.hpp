// LineCost: how much longer a program takes over a line to a board with few places, told before the run.
//
// The program is played over a virtual line to a virtual board with the places of the machine file, in virtual time:
// just what `passo run --cut-cable-at` does. A minute of machining takes some tenths of a second,
// with limits of jerk some seconds.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/activity/program.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
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

// The motion and the dwells of a program that was checked, as planned: the time without a line.
Seconds planned_time(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                     const ProgramCheck& check);

// Plays a program that was checked over the line. `without` is its planned time. Empty: the machine file names no
// places, or the way depends on a probe.
std::optional<LineCost> line_cost(ProgramReader program, const MachineDescription& machine,
                                  const InterpreterOptions& options, const ProgramCheck& check, Seconds without);

// A line for the page of `passo check`, with a line end.
std::string to_text(const LineCost& cost);
nlohmann::ordered_json as_json(const LineCost& cost);

}  // namespace passo
