#include "passo/surface_file/surface_file.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <utility>

#include "stl_file.hpp"
#include "threemf_file.hpp"

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/levelling/height_map.hpp"

namespace passo {
namespace {

std::vector<SurfaceTriangle> read_body(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return looks_like_3mf(bytes) ? read_3mf(name, bytes, diagnostics) : read_stl(name, bytes, diagnostics);
}

bool is_text(std::string_view bytes) {
  return bytes.substr(0, 4096).find('\0') == std::string_view::npos;
}

// Two triangles a cell bound it; its height is that of the map.
SurfaceFaces faces_of(const HeightMap& map) {
  const auto corner = [&](std::size_t column, std::size_t row) {
    return SurfacePoint{map.columns()[column], map.rows()[row], map.at(column, row)};
  };
  std::vector<SurfaceTriangle> all;
  all.reserve(2 * map.columns().size() * map.rows().size());
  for (std::size_t y = 0; y + 1 < map.rows().size(); ++y) {
    for (std::size_t x = 0; x + 1 < map.columns().size(); ++x) {
      all.push_back({corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)});
      all.push_back({corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)});
    }
  }
  return {std::move(all), [map](double x, double y) { return map.height(x, y); }};
}

}  // namespace

bool looks_like_body(std::string_view bytes) {
  return looks_like_stl(bytes) || looks_like_3mf(bytes);
}

bool states_its_unit(std::string_view bytes) {
  return looks_like_3mf(bytes);
}

SurfaceFaces read_faces(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  if (looks_like_body(bytes)) return {read_body(name, bytes, diagnostics), {}};
  if (is_text(bytes)) {
    const std::optional<HeightMap> map = read_height_map(name, bytes, diagnostics);
    return map ? faces_of(*map) : SurfaceFaces();
  }
  diagnostics.add(of_file("surface.unknown-kind", name, "this is neither an STL or 3MF file nor a height map",
                          "STL, text or binary, 3MF, or lines x,y,z"));
  return {};
}

Surface read_surface(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  SurfaceFaces faces = read_faces(name, bytes, diagnostics);
  return faces.triangles.empty() ? Surface() : Surface(std::move(faces.triangles), std::move(faces.height));
}

// Sorts the edges by the bits of their ends. Two different edges with the same number are too rare to matter.
std::size_t open_edges(const std::vector<SurfaceTriangle>& triangles) {
  const auto number = [](const SurfacePoint& point) {
    std::uint64_t all = 0;
    for (const double value : {point.x, point.y, point.z}) {
      all = (all ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x9E3779B97F4A7C15U;  // + 0.0: -0 is 0
      all ^= all >> 32U;
    }
    return all;
  };
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * triangles.size());
  for (const SurfaceTriangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t a = number(triangle[i]);
      const std::uint64_t b = number(triangle[(i + 1) % 3]);
      if (a != b) edges.push_back(a * b + (a ^ b));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    open += (end - i) % 2;
    i = end;
  }
  return open;
}

std::vector<SurfaceTriangle> read_triangles(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes = read_bytes(path, {.area = "surface", .expected = "an STL or 3MF file"}, diagnostics);
  if (!bytes) return {};
  if (looks_like_body(*bytes)) return read_body(path, *bytes, diagnostics);
  diagnostics.add(of_file("surface.unknown-kind", path, "this is not an STL or 3MF file",
                          "an STL model, text or binary, or a 3MF model"));
  return {};
}

Surface read_surface(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes =
      read_bytes(path, {.area = "surface", .expected = "an STL or 3MF file or a height map"}, diagnostics);
  if (!bytes) return {};
  return read_surface(path, *bytes, diagnostics);
}

}  // namespace passo
