// --disturb: a disturbance torque on an axis of a virtual or emulated machine with physics, for a limited time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/rotor_plant.hpp"

namespace passo {

// Parses "X:0.8@1.5:0.2": 0.8 N·m against the motor of X, starting at 1.5 s of the board's time, for 0.2 s. Reports
// invalid texts, and axes without a described motor, on standard error, and returns nothing.
std::optional<std::vector<Disturbance>> read_disturbances(const std::vector<std::string>& texts,
                                                          const MachineDescription& machine);

}  // namespace passo
