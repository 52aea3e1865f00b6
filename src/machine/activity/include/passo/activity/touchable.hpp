// Touchable: something that the probe of a plant can touch, as a user describes it, in machine coordinates.
#pragma once

#include <limits>
#include <memory>
#include <variant>

#include "passo/geometry/axes.hpp"
#include "passo/geometry/surface.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/fitted_plant.hpp"

namespace passo {

// A box. A range without an end goes on for ever.
struct TouchBox {
  struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
  };
  PerAxis<Range> ranges;
};

// All that is on or below a surface whose zero is somewhere in the machine.
struct PlacedSurface {
  std::shared_ptr<const Surface> surface;
  Point zero = {};
};

using Touchable = std::variant<TouchBox, PlacedSurface>;

// Puts it before the probe of the plant. Axes that the machine does not have are left out.
void add(FittedPlant& plant, const Touchable& thing, const MachineDescription& machine);

}  // namespace passo
