// Reads what a machine file says of homing: [homing], and the table [axis.X.home] of each axis with a homing switch.
#pragma once

#include <optional>
#include <vector>

#include "table_reader.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

// Reads the table of one axis, whose travel and velocity must be known. Returns nothing where anything is wrong.
std::optional<HomeDescription> read_home(TableReader& reader, const AxisDescription& axis);

// The axes in the order in which they are homed. `homing` is the table, if there is one. `complete` means that no table
// [axis.X.home] was wrong.
std::vector<Axis> read_homing_order(TableReader* homing, const std::vector<AxisDescription>& axes, bool complete);

}  // namespace passo
