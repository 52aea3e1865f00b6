// Adds the machine's data to the host's handshake with a board.
#pragma once

#include "passo/link/board_session.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// Returns `greeting` with the machine's motors, pins, pairs and silence times. Without a link no pulse times are set,
// because a board inside this process has no step pins.
Greeting with_machine(Greeting greeting, const MachineDescription& machine, bool over_a_line);

}  // namespace passo
