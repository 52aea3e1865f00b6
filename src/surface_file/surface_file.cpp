#include "passo/surface_file/surface_file.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/levelling/height_map.hpp"

namespace passo {
namespace {

constexpr std::size_t binary_head = 84;      // bytes before the first triangle
constexpr std::size_t binary_triangle = 50;  // bytes

// What the head of a binary STL file promises, or nothing.
std::optional<std::size_t> binary_triangles(std::string_view bytes) {
  if (bytes.size() < binary_head) return std::nullopt;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) count |= std::size_t{static_cast<unsigned char>(bytes[80 + i])} << (8 * i);
  if (bytes.size() != binary_head + count * binary_triangle) return std::nullopt;
  return count;
}

bool is_text(std::string_view bytes) {
  return bytes.substr(0, 4096).find('\0') == std::string_view::npos;
}

bool looks_like_text_stl(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes.substr(first, 5) == "solid" &&
         bytes.substr(0, 1 << 16).find("facet") != std::string_view::npos;
}

bool is_within(const SurfaceTriangle& triangle) {
  return std::ranges::all_of(triangle, [](const SurfacePoint& point) {
    return std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) <= farthest_surface &&
           std::isfinite(point.x + point.y + point.z);
  });
}

std::vector<SurfaceTriangle> read_stl(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  const auto refuse = [&](std::string message, std::string expected) {
    diagnostics.add(of_file("surface.stl", name, std::move(message), std::move(expected)));
    return std::vector<SurfaceTriangle>();
  };
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "stl");
  if (scene == nullptr) return refuse(fmt::format("is no STL file: {}", importer.GetErrorString()), "");
  std::vector<SurfaceTriangle> all;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      const auto corner = [&](unsigned i) {
        const aiVector3D& at = mesh.mVertices[face.mIndices[i]];
        return SurfacePoint{at.x, at.y, at.z};
      };
      all.push_back({corner(0), corner(1), corner(2)});
      if (all.size() > most_triangles)
        return refuse("has too many triangles", fmt::format("at most {}", most_triangles));
      if (!is_within(all.back())) {
        return refuse(fmt::format("triangle {} is too far away", all.size()),
                      fmt::format("places of at most {:g} mm", farthest_surface));
      }
    }
  }
  if (all.empty()) return refuse("has no triangle", "");
  return all;
}

std::vector<SurfaceTriangle> triangles_of(const HeightMap& map) {
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
  return all;
}

}  // namespace

bool looks_like_body(std::string_view bytes) {
  return binary_triangles(bytes) || looks_like_text_stl(bytes);
}

Surface read_surface(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  if (looks_like_body(bytes)) return Surface(read_stl(name, bytes, diagnostics));
  if (is_text(bytes)) {
    const std::optional<HeightMap> map = read_height_map(name, bytes, diagnostics);
    return map ? Surface(triangles_of(*map)) : Surface();
  }
  diagnostics.add(of_file("surface.unknown-kind", name, "this is neither an STL file nor a height map",
                          "STL, text or binary, or lines x,y,z"));
  return {};
}

Surface read_surface(const std::string& path, Diagnostics& diagnostics) {
  const auto bytes = read_bytes(path, {.area = "surface", .expected = "an STL file or a height map"}, diagnostics);
  if (!bytes) return {};
  return read_surface(path, *bytes, diagnostics);
}

}  // namespace passo
