// The spindle of a machine file, at an emulated board's outputs and encoder pins.
#pragma once

#include "passo/link/board_port.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// Where the board is an emulated one, and the machine has an encoder. `board` may be none.
void fit_emulated_spindle(const SpindleDescription& spindle, BoardPort* board);

}  // namespace passo
