// Surface: the top of a solid, as a height map seen from above: a height Z for each X and Y.
//
// The surface is the highest of its triangles. For a surface that is curved between the corners of its triangles, a
// function gives the height. The space under an overhang counts as solid; vertical triangles have no area seen from
// above, and their neighbours bound the wall. Outside the triangles there is no surface.
//
// All lengths are millimetres. Cost: top() checks the triangles of one cell, clearance() about 90 heights. Memory: some
// 100 bytes per triangle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace passo {

struct SurfacePoint {
  double x = 0;
  double y = 0;
  double z = 0;
};
using SurfaceTriangle = std::array<SurfacePoint, 3>;

class Surface {
 public:
  // The height where there is no surface.
  static constexpr double nothing = -std::numeric_limits<double>::infinity();

  Surface() = default;
  // `height` gives the height of a curved surface, nowhere above the highest corner of the triangles there. None: the
  // triangles are flat.
  explicit Surface(std::vector<SurfaceTriangle> triangles, std::function<double(double x, double y)> height = {});

  // Returns the height at a position, or `nothing`.
  double top(double x, double y) const;
  // Returns the distance that a point can move in each of X, Y and Z without touching the surface or the solid below. 0
  // if it may touch at once.
  double clearance(const SurfacePoint& point) const;
  // The corners of the bounding box; `low` is above `high` if there is no surface.
  const SurfacePoint& low() const { return low_; }
  const SurfacePoint& high() const { return high_; }
  std::size_t triangles() const { return triangles_.size(); }

 private:
  // The highest triangle corner above each cell. The cells of each level are twice as large as those of the level
  // before.
  struct Level {
    double size = 0;
    std::size_t across = 0;
    std::size_t up = 0;
    std::vector<float> highest = {};
  };

  struct CellRange {
    std::size_t first_x = 0;
    std::size_t last_x = 0;
    std::size_t first_y = 0;
    std::size_t last_y = 0;
  };

  CellRange cells_under(const SurfaceTriangle& triangle) const;
  void choose_cells();
  void sort_into_cells();
  void add_levels();
  static double clearance_at(const Level& level, double x, double y, double z);

  std::vector<SurfaceTriangle> triangles_;
  std::function<double(double, double)> height_;
  SurfacePoint low_{1, 1, 1};
  SurfacePoint high_{};
  std::vector<Level> levels_;
  std::vector<std::uint32_t> begins_;  // for each cell, its start in `members_`
  std::vector<std::uint32_t> members_;
};

}  // namespace passo
