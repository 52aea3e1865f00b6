// The limit switches by which a machine is homed, as a virtual machine has them: where the machine file says that they
// close.
#pragma once

#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/machine/travel_switch.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// In steps from where the machine stands, `start` in machine coordinates. They open `hysteresis` further off.
std::vector<TravelSwitch> home_switches(const MachineDescription& machine, const Point& start,
                                        Mm hysteresis = Mm(0.05));

}  // namespace passo
