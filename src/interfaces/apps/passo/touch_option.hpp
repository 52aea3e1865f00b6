// --touch: objects on a virtual or emulated machine that its probe can touch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/activity/touchable.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// "Z:-1.5" is everything below -1.5; "X10:60,Y10:50,Z:-2" is a block. The ranges are in machine coordinates. A missing
// end or axis is unlimited. "part.stl" and "map.csv" are surfaces from files, "part.stl@X100,Y80,Z-20" is one whose
// zero is at that position. Reports any other text, an axis that the machine does not have, and a file that cannot be
// read, on standard error, and returns nothing.
std::optional<std::vector<Touchable>> read_touch_options(const std::vector<std::string>& texts,
                                                         const MachineDescription& machine);

}  // namespace passo
