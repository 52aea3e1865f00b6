// read_height_map: the points of a grid, as lines x,y,z. See surface_file.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/surface/surface.hpp"

namespace passo {

std::vector<SurfaceTriangle> read_height_map(const std::string& name, std::string_view text, Diagnostics& diagnostics);

}  // namespace passo
