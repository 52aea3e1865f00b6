// read_surface: a Surface from a file: a body (STL, text or binary) or a height map (CSV). The kind is told by what is
// in the file.
//
// A height map has a line x,y,z for each point of a grid. Between the points its surface is that of HeightMap
// (levelling/height_map.hpp), so a program that is levelled by a map meets the surface of that map.
//
// Files are in millimetres. What a file says is bounded: its size, the triangles, and how far they lie. Errors are
// diagnostics "surface.…".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/surface.hpp"

namespace passo {

inline constexpr std::size_t most_triangles = 10'000'000;
inline constexpr double farthest_surface = 1e5;  // mm

// Errors are in `diagnostics`; the surface then has nothing.
Surface read_surface(const std::string& path, Diagnostics& diagnostics);

// The same, of a file that was read.
Surface read_surface(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

// The triangles of a body (STL). Errors are in `diagnostics`; another kind of file is one.
std::vector<SurfaceTriangle> read_triangles(const std::string& path, Diagnostics& diagnostics);

// Whether the bytes are those of a body (STL), not of a height map.
bool looks_like_body(std::string_view bytes);

}  // namespace passo
