// GrblMatch: how a machine file suits the settings of a Grbl board: steps, rates, travel and homing corner.
//
// A file of another machine has other places: a tool that rises to the top of its travel may leave that of the board.
#pragma once

#include <optional>

#include "passo/base/sentence.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/sender/grbl_machine.hpp"

namespace passo {

struct GrblMatch {
  // "grbl.other-machine": what differs, with both values. Empty: nothing, or the board does not tell its settings.
  // A file with a smaller travel or lower speeds than the board suits it.
  std::optional<Sentence> warning = {};
  // "grbl.outside-travel": a travel with no place in common with that of the board, whose soft limits are on ($20). No
  // program may run.
  std::optional<Sentence> objection = {};
};

GrblMatch match_with_board(const MachineDescription& machine, const GrblMachine& board);

}  // namespace passo
