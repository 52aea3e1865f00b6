// read_3mf: reads the triangles of a 3MF model. Private to surface_file/.
//
// A 3MF file is a zip archive with a model in XML. Its build items refer to objects; an object is a mesh, or consists
// of other objects, also of those in other files of the archive. Items and components have transforms, which are
// applied. Coordinates are converted from the unit of the file to mm. Objects that are supports or of the type "other"
// (e.g. the modifiers of a slicer) are omitted, and so are colours and other properties.
//
// The numbers of vertices, triangles, objects and bytes are bounded before memory is requested; entities are rejected.
//
// Source: 3D Manufacturing Format, core specification 1.3, and its production extension 1.1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/surface.hpp"

namespace passo {

bool looks_like_3mf(std::string_view bytes);

// Returns an empty list and reports "surface.3mf" on failure. Limits: most_triangles and farthest_surface.
std::vector<SurfaceTriangle> read_3mf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace passo
