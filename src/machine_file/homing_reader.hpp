// What a machine file says of homing: the table [axis.X.home] of each axis that has a switch for it, and [homing].
#pragma once

#include <optional>
#include <vector>

#include "table_reader.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

// Of an axis whose travel and velocity are known, as far as the file is right. Nothing where anything is wrong.
std::optional<HomeDescription> read_home(TableReader& reader, const AxisDescription& axis);

// The axes in the order in which they are homed. `homing`: the table, if there is one. `complete`: no table
// [axis.X.home] was wrong.
std::vector<Axis> read_homing_order(TableReader* homing, const std::vector<AxisDescription>& axes, bool complete);

}  // namespace passo
