// --touch: what stands on a virtual or emulated machine for its probe to touch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/activity/touch_box.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// "Z:-1.5" is everything below, "X10:60,Y10:50,Z:-2" a block: from where to where on each axis, machine coordinates;
// an end that is not there, or an axis, goes on for ever. Nothing where a text says something else, or names an axis
// that the machine has not; that is told on standard error.
std::optional<std::vector<TouchBox>> read_touch_options(const std::vector<std::string>& texts,
                                                        const MachineDescription& machine);

}  // namespace passo
