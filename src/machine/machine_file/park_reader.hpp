// Reads [park]: the park position, and the motion at the end of a program.
#pragma once

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// Requires that all axes are known.
ParkDescription read_park(TableReader& reader, const std::vector<AxisDescription>& axes);

}  // namespace passo
