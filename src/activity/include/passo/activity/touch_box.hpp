// TouchBox: something that the probe of a plant can touch, as a user describes it: a box in machine coordinates.
#pragma once

#include <limits>

#include "passo/geometry/axes.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/touch_body.hpp"

namespace passo {

// The box's range on each axis. A range without an end goes on for ever.
struct TouchBox {
  struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
  };
  PerAxis<Range> ranges;
};

// The box as ranges of motor steps. Axes that the machine does not have are left out.
TouchBody touch_body(const TouchBox& box, const MachineDescription& machine);

}  // namespace passo
