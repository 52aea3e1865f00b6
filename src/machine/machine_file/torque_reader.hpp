// Reads the table [axis.X.torque] of a machine file: an axis's motor, its drive and its load.
#pragma once

#include <optional>

#include "table_reader.hpp"

#include "passo/machine_file/axis_motor.hpp"

namespace passo {

// `unit_per_turn` is millimetres or degrees of the axis for one turn of the motor. Without it there is a diagnostic.
// Returns nothing where anything is wrong.
std::optional<AxisMotor> read_torque(TableReader& reader, bool rotary, std::optional<double> unit_per_turn);

}  // namespace passo
