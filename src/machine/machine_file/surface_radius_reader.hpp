// Reads the radius of the cylinder that a rotary axis turns: radius_mm in [axis.A].
#pragma once

#include <optional>

#include "passo/geometry/axes.hpp"
#include "passo/toml/table_reader.hpp"
#include "passo/units/units.hpp"

namespace passo {

// 0: the distance of the tool from the rotation axis.
std::optional<Mm> read_surface_radius(TableReader& reader, Axis axis);

}  // namespace passo
