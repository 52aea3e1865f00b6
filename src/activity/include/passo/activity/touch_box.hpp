// TouchBox: something that the probe of a plant can touch, as its user describes it: a box in machine coordinates.
#pragma once

#include <limits>

#include "passo/geometry/axes.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/touch_body.hpp"

namespace passo {

// From where to where on each axis; without an end there it goes on for ever.
struct TouchBox {
  struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
  };
  PerAxis<Range> ranges;
};

// The steps at which the machine is in it. An axis that the machine has not stands at 0.
TouchBody touch_body(const TouchBox& box, const MachineDescription& machine);

}  // namespace passo
