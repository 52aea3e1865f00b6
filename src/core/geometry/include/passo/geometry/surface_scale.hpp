// SurfaceScale: the distance that the surface of a cylinder moves for each degree of the axis that turns it. It also
// stores the unit of the angles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "passo/geometry/axes.hpp"

namespace passo {

struct SurfaceScale {
  std::array<double, 3> mm_per_degree{};  // of A, B and C; 0: the axis does not count for the length s
  double unit = 1;                        // degrees for 1 of A, B and C; then mm_per_degree is for this unit, too

  double& operator[](Axis axis) { return mm_per_degree[index_of(axis) - index_of(Axis::a)]; }
  double operator[](Axis axis) const { return mm_per_degree[index_of(axis) - index_of(Axis::a)]; }
  bool counts_any() const {
    return std::ranges::any_of(mm_per_degree, [](double scale) { return scale > 0; });
  }
  // The same for angles in other units, of `degrees` each.
  SurfaceScale in_units_of(double degrees) const {
    SurfaceScale other;
    other.unit = unit * degrees;
    for (std::size_t i = 0; i < mm_per_degree.size(); ++i) other.mm_per_degree[i] = mm_per_degree[i] * degrees;
    return other;
  }
  // The square of the way of the surface.
  double square_of(const Point& travel) const {
    double sum = 0;
    for (std::size_t i = 0; i < mm_per_degree.size(); ++i) {
      const double way = mm_per_degree[i] * travel.values[index_of(Axis::a) + i];
      sum += way * way;
    }
    return sum;
  }
  friend bool operator==(const SurfaceScale&, const SurfaceScale&) = default;
};

}  // namespace passo
