// cover_body: heights at the nodes of a grid whose bilinear patches lie nowhere below a body. Private to carve/.
//
// Where possible, the height of a node is that of the body. This is enough in a cell that one triangle covers
// completely, because a patch with corners on or above a plane is above it. In the other cells the body is highest,
// relative to the patch, at the ends of edges or where edges cross the lines of the grid. If the body rises little
// above the patch there, all corners of the cell are raised by that much; at a wall, a rib or a tip they are raised to
// the highest point in the cell. So a wall is moved outwards by less than two cells, and never inwards.
//
// Cost: the nodes under each triangle and the cells along each edge. The grid is processed in bands of rows, with
// memory for one band per thread.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "passo/geometry/surface.hpp"

namespace passo {

struct BodyCover {
  std::size_t columns = 0;  // at least 2
  std::size_t rows = 0;
  double pitch = 0;  // mm, the larger one
  float floor = 0;   // where there is no body
  unsigned threads = 1;
  // Returns the height at a node, instead of that of the highest triangle.
  std::function<double(double x, double y)> at_node = {};
  // Returns the height at a point of an edge, beside which the body lies in the directions (x, y) and -(x, y).
  std::function<double(const SurfacePoint& point, double x, double y)> at_edge = {};
  // Edges that are not parallel to X or Y are lines of the triangles only, not of the body.
  bool has_straight_edges_only = false;
};

// `faces`: X in columns, Y in rows, Z in mm.
std::vector<float> cover_body(const std::vector<SurfaceTriangle>& faces, const BodyCover& cover);

}  // namespace passo
