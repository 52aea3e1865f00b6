// Reads [handwheel]: a handwheel at pins of the board.
#pragma once

#include <vector>

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// `axes`: those of the machine. Invalid values are reported and omitted.
HandwheelDescription read_handwheel(TableReader& reader, const std::vector<AxisDescription>& axes);

}  // namespace passo
