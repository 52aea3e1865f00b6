// Reads what a machine file says of homing: [homing], and the table [axis.X.home] of each axis with a homing switch.
#pragma once

#include <optional>
#include <vector>

#include "table_reader.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

// Reads the table of one axis, whose travel and velocity must be known. Returns nothing where anything is wrong.
std::optional<HomeDescription> read_home(TableReader& reader, const AxisDescription& axis);

// Reads the table of an axis's second motor. Returns nothing where anything is wrong.
std::optional<SecondMotor> read_second_motor(TableReader& reader, const AxisDescription& axis);

// An order of homing. Of each axis: axes with the same number of turn seek their switches at once.
struct HomingOrder {
  std::vector<Axis> axes;
  std::vector<int> turns;
};

// The axes in the order in which they are homed. `homing` is the table, if there is one. `complete` means that no table
// [axis.X.home] was wrong.
HomingOrder read_homing_order(TableReader* homing, const std::vector<AxisDescription>& axes, bool complete);

}  // namespace passo
