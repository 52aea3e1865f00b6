// The table [axis.X.torque] of a machine file: an axis's motor, what it is driven by and what it turns.
#pragma once

#include <optional>

#include "table_reader.hpp"

#include "passo/machine_file/axis_motor.hpp"

namespace passo {

// `unit_per_turn`: of the axis's scale, millimetres or degrees for one turn of the motor; without it there is a
// diagnostic. Nothing where anything is wrong.
std::optional<AxisMotor> read_torque(TableReader& reader, bool rotary, std::optional<double> unit_per_turn);

}  // namespace passo
