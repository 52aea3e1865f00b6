// What the board has done in a run, for its summary.
#pragma once

#include <cstdint>

#include "machine_connection.hpp"

#include "passo/report/summary.hpp"

namespace passo {

// What the machine and the line had done before the program began. If the machine was homed first, this is all up to
// the end of homing. If not, this is nothing, so the hello counts as the program's.
struct BoardBefore {
  MachineCounts counts;
  Ticks time;
  std::uint64_t frames = 0;
  std::uint64_t bytes = 0;
};
BoardBefore board_before(MachineConnection& machine);
void add_board(RunSummary& summary, MachineConnection& opened, const MachineDescription& machine,
               const BoardBefore& before);

}  // namespace passo
