// Touchable: an object that the probe of a plant can touch, as described by the user, in machine coordinates.
#pragma once

#include <limits>
#include <memory>
#include <variant>

#include "passo/geometry/axes.hpp"
#include "passo/geometry/surface.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/fitted_plant.hpp"

namespace passo {

// A box. A range without an end is unlimited.
struct TouchBox {
  struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
  };
  PerAxis<Range> ranges;
};

// A surface placed in the machine; everything on or below it is solid.
struct PlacedSurface {
  std::shared_ptr<const Surface> surface;
  Point zero = {};
};

using Touchable = std::variant<TouchBox, PlacedSurface>;

// Adds the object to the plant. Axes that the machine does not have are ignored.
void add(FittedPlant& plant, const Touchable& thing, const MachineDescription& machine);

}  // namespace passo
