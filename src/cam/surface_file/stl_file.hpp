// read_stl: reads the triangles of an STL model, text or binary. Private to surface_file/.
//
// A binary file has a header of 80 bytes, the number of triangles, and 50 bytes per triangle. A text file has keywords:
// solid, then for each triangle facet, normal, outer, loop, three times vertex with three numbers, endloop, endfacet.
// The normals are not used.
//
// Source: 3D Systems, StereoLithography Interface Specification, 1989.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/surface.hpp"

namespace passo {

bool looks_like_stl(std::string_view bytes);

// Returns an empty list and reports "surface.stl" on failure, with line and column for a text file. Limits:
// most_triangles and farthest_surface.
std::vector<SurfaceTriangle> read_stl(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace passo
