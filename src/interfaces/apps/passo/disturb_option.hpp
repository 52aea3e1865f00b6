// --disturb: what holds an axis of a virtual or emulated machine with physics, for a time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/rotor_plant.hpp"

namespace passo {

// "X:0.8@1.5:0.2" is 0.8 N·m against the motor of X, from 1.5 s of the board's time on, for 0.2 s. Any other text, or
// an axis without a described motor, is reported on standard error, and the result is empty.
std::optional<std::vector<Disturbance>> read_disturbances(const std::vector<std::string>& texts,
                                                          const MachineDescription& machine);

}  // namespace passo
