// read_stl: the triangles of a body in an STL file, text or binary. Private to surface_file/.
//
// A binary file has 80 bytes of any content, the number of triangles, and 50 bytes each. A text file has words: solid,
// then for each triangle facet, normal, outer, loop, three times vertex with three numbers, endloop, endfacet. The
// normals are not used.
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

// Empty with an error "surface.stl", of text with its line and column. At most most_triangles; none lies farther than
// farthest_surface.
std::vector<SurfaceTriangle> read_stl(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace passo
