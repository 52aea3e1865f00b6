// What the host says to a board about its machine in the handshake.
#pragma once

#include "passo/link/board_session.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// `greeting` with the machine's motors, pins, pairs and times of silence. Without a line it sets no pulses: those of a
// board within this process go nowhere.
Greeting with_machine(Greeting greeting, const MachineDescription& machine, bool over_a_line);

}  // namespace passo
