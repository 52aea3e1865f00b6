// Bodies for tests and benchmarks, as lists of faces in mm.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "passo/carve/relief_surface.hpp"

namespace passo::test {

using Faces = std::vector<SurfaceTriangle>;

inline void add(Faces& to, const Faces& more) {
  to.insert(to.end(), more.begin(), more.end());
}

inline Faces box(double x0, double y0, double z0, double x1, double y1, double z1) {
  const auto corner = [&](int i) {
    return SurfacePoint{(i & 1) != 0 ? x1 : x0, (i & 2) != 0 ? y1 : y0, (i & 4) != 0 ? z1 : z0};
  };
  constexpr int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Faces faces;
  for (const auto& side : sides) {
    faces.push_back({corner(side[0]), corner(side[1]), corner(side[2])});
    faces.push_back({corner(side[0]), corner(side[2]), corner(side[3])});
  }
  return faces;
}

inline Faces turned(Faces faces, double degrees, double x, double y) {
  const double c = std::cos(degrees * std::numbers::pi / 180);
  const double s = std::sin(degrees * std::numbers::pi / 180);
  for (SurfaceTriangle& face : faces) {
    for (SurfacePoint& p : face) {
      p = {x + (p.x - x) * c - (p.y - y) * s, y + (p.x - x) * s + (p.y - y) * c, p.z};
    }
  }
  return faces;
}

// A surface with `columns` times `rows` squares, e.g. a scan.
template <class Height>
Faces terrain(double wide, double deep, int columns, int rows, const Height& height) {
  std::vector<SurfacePoint> points;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double x = wide * i / columns;
      const double y = deep * j / rows;
      points.push_back({x, y, height(x, y)});
    }
  }
  Faces faces;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto at = [&](int k, int l) {
        return points[static_cast<std::size_t>(j + l) * static_cast<std::size_t>(columns + 1) +
                      static_cast<std::size_t>(i + k)];
      };
      faces.push_back({at(0, 0), at(1, 0), at(1, 1)});
      faces.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return faces;
}

}  // namespace passo::test
