// --touch: things on a virtual or emulated machine that its probe can touch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/activity/touchable.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// "Z:-1.5" is everything below -1.5; "X10:60,Y10:50,Z:-2" is a block. The ranges are in machine coordinates. A missing
// end or a missing axis means no limit. "part.stl" and "map.csv" are surfaces in files, "part.stl@X100,Y80,Z-20" is one
// whose zero lies there. Any other text, an axis that the machine does not have, or a file that cannot be read, is
// reported on standard error, and the result is empty.
std::optional<std::vector<Touchable>> read_touch_options(const std::vector<std::string>& texts,
                                                         const MachineDescription& machine);

}  // namespace passo
