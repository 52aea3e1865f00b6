// Reads the table [axis.X.torque] of a machine file: an axis' motor, its drive and its load.
#pragma once

#include <optional>

#include "passo/machine_file/axis_motor.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// `unit_per_turn` is the axis travel per motor revolution, in millimetres or degrees. Without it there is a diagnostic.
// Returns nothing if any value is invalid.
std::optional<AxisMotor> read_torque(TableReader& reader, bool rotary, std::optional<double> unit_per_turn);

}  // namespace passo
