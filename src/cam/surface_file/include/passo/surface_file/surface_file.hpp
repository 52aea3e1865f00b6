// read_surface: reads a Surface from a file: a model (STL, text or binary, or 3MF) or a height map (CSV). The format is
// detected from the contents.
//
// A height map has a line x,y,z for each point of a grid. Between the points its surface is that of HeightMap
// (levelling/height_map.hpp), so a program that is levelled by a map fits the surface of that map.
//
// STL files and height maps are in millimetres; a 3MF file states its unit. Limits apply to the file size, the number
// of triangles and the coordinates. Errors are diagnostics "surface.…".
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/surface.hpp"

namespace passo {

inline constexpr std::size_t most_triangles = 10'000'000;
inline constexpr double farthest_surface = 1e5;  // mm

// Reports errors in `diagnostics`; the surface is then empty.
Surface read_surface(const std::string& path, Diagnostics& diagnostics);

// Does the same for a file in memory.
Surface read_surface(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

// The faces of a surface. If `height` is set, it gives the height between the corners.
struct SurfaceFaces {
  std::vector<SurfaceTriangle> triangles = {};
  std::function<double(double x, double y)> height = {};
};
// Does the same without building a Surface: a program that looks at each face once needs a third of the memory.
SurfaceFaces read_faces(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

// Returns the number of edges that do not belong to two triangles (or four, six…). 0: the model is closed.
std::size_t open_edges(const std::vector<SurfaceTriangle>& triangles);

// Reads the triangles of a model (STL or 3MF). Reports errors in `diagnostics`, also for other file formats.
std::vector<SurfaceTriangle> read_triangles(const std::string& path, Diagnostics& diagnostics);

// Returns whether the bytes are a model (STL or 3MF) rather than a height map.
bool looks_like_body(std::string_view bytes);
// Returns whether the format of this model states a unit (3MF).
bool states_its_unit(std::string_view bytes);

}  // namespace passo
