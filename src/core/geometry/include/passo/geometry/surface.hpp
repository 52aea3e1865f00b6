// Surface: the upper face of a body, seen from above: a height Z for each X and Y.
//
// The face is the highest of its triangles. A face that is curved between the corners of its triangles gives its height
// itself. What an edge hangs over is taken for solid; upright triangles have no area
// seen from above, and their neighbours bound the wall. Beside the triangles there is nothing.
//
// All lengths are millimetres. Cost: top() looks at the triangles of one cell, clearance() at about 90 heights. Memory:
// some 100 bytes a triangle.
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
  // Where there is no surface.
  static constexpr double nothing = -std::numeric_limits<double>::infinity();

  Surface() = default;
  // `height`: of a face that is nowhere higher than the highest corner of the triangles there. None: the triangles are
  // flat.
  explicit Surface(std::vector<SurfaceTriangle> triangles, std::function<double(double x, double y)> height = {});

  // The height at a place, or `nothing`.
  double top(double x, double y) const;
  // How far a point may go in X, Y and Z, each, and does surely not touch what is on or below the surface. 0 where it
  // may touch at once.
  double clearance(const SurfacePoint& point) const;
  // The corners of the box around the surface; `low` is above `high` where there is no surface.
  const SurfacePoint& low() const { return low_; }
  const SurfacePoint& high() const { return high_; }
  std::size_t triangles() const { return triangles_.size(); }

 private:
  // The highest corner of the triangles above each cell. Each level has cells twice as large as the one before.
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
  std::vector<std::uint32_t> begins_;  // of each cell, in `members_`
  std::vector<std::uint32_t> members_;
};

}  // namespace passo
