// Reads the homing data of a machine file: [homing], and the table [axis.X.home] of each axis with a homing switch.
#pragma once

#include <optional>
#include <vector>

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// Reads the table of one axis, whose travel and velocity must be known. Returns nothing if any value is invalid.
std::optional<HomeDescription> read_home(TableReader& reader, const AxisDescription& axis);

// Reads the table of an axis' second motor. Returns nothing if any value is invalid.
std::optional<SecondMotor> read_second_motor(TableReader& reader, const AxisDescription& axis);

// The homing order. `turns` has a number for each axis: axes with the same number seek their switches together.
struct HomingOrder {
  std::vector<Axis> axes;
  std::vector<int> turns;
};

// Returns the axes in homing order. `homing` is the table, if there is one. `complete`: all tables [axis.X.home] are
// valid.
HomingOrder read_homing_order(TableReader* homing, const std::vector<AxisDescription>& axes, bool complete);

}  // namespace passo
