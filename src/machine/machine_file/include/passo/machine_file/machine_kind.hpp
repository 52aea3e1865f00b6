// Determines the kind of a machine from its axes.
#pragma once

#include <algorithm>

#include "passo/machine_file/machine_description.hpp"

namespace passo {

inline bool has_axis(const MachineDescription& machine, Axis axis) {
  return std::ranges::find(machine.axes, axis, &AxisDescription::axis) != machine.axes.end();
}
// Returns true for a machine with X and Z, but without Y.
inline bool is_lathe(const MachineDescription& machine) {
  return has_axis(machine, Axis::x) && has_axis(machine, Axis::z) && !has_axis(machine, Axis::y);
}

}  // namespace passo
