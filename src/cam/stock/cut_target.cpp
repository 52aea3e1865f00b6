#include "passo/stock/cut_target.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace passo {
namespace {

// A convex polygon: a triangle between two parallels to each axis has at most seven corners.
struct CutFace {
  std::array<SurfacePoint, 12> corners;
  std::size_t count = 0;

  void add(const SurfacePoint& point) {
    if (count < corners.size()) corners[count++] = point;
  }
};

double axis_of(const SurfacePoint& point, bool is_y) {
  return is_y ? point.y : point.x;
}

// The part on one side of a line x = `at` or y = `at`.
CutFace part_of(const CutFace& face, bool is_y, double at, double side) {
  CutFace part;
  for (std::size_t i = 0; i < face.count; ++i) {
    const SurfacePoint& a = face.corners[i];
    const SurfacePoint& b = face.corners[(i + 1) % face.count];
    const double of_a = (axis_of(a, is_y) - at) * side;
    const double of_b = (axis_of(b, is_y) - at) * side;
    if (of_a >= 0) part.add(a);
    if ((of_a < 0) == (of_b < 0) || of_a == 0 || of_b == 0) continue;
    const double share = of_a / (of_a - of_b);
    part.add({a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, a.z + (b.z - a.z) * share});
  }
  return part;
}

CutFace between(const CutFace& face, bool is_y, double low, double high) {
  return part_of(part_of(face, is_y, low, 1), is_y, high, -1);
}

// The cells along one axis that a face touches.
struct CellSpan {
  std::size_t first = 1;
  std::size_t last = 0;
};
CellSpan cells_of(const CutFace& face, bool is_y, double low, double cell, std::size_t cells) {
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (std::size_t i = 0; i < face.count; ++i) {
    from = std::min(from, axis_of(face.corners[i], is_y));
    to = std::max(to, axis_of(face.corners[i], is_y));
  }
  const double first = std::floor((from - low) / cell);
  const double last = std::floor((to - low) / cell);
  if (face.count == 0 || last < 0 || first >= static_cast<double>(cells)) return {};
  return {static_cast<std::size_t>(std::max(0.0, first)),
          static_cast<std::size_t>(std::min(static_cast<double>(cells - 1), last))};
}

void raise(HeightField& field, std::size_t column, std::size_t row, double z) {
  const double height = std::min(z, field.top());
  if (height > field.height(column, row)) field.set_height(column, row, height);
}

void put_highest(const SurfaceTriangle& triangle, HeightField& field) {
  CutFace face;
  for (const SurfacePoint& corner : triangle) face.add(corner);
  const StockBlock& block = field.block();
  const double cell = field.cell();
  const CellSpan rows = cells_of(face, true, block.low.y, cell, field.rows());
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    const double y = block.low.y + static_cast<double>(row) * cell;
    const CutFace strip = between(face, true, y, y + cell);
    const CellSpan columns = cells_of(strip, false, block.low.x, cell, field.columns());
    for (std::size_t column = columns.first; column <= columns.last; ++column) {
      const double x = block.low.x + static_cast<double>(column) * cell;
      const CutFace part = between(strip, false, x, x + cell);
      for (std::size_t i = 0; i < part.count; ++i) raise(field, column, row, part.corners[i].z);
    }
  }
}

}  // namespace

CutTarget target_of(const HeightField& heights) {
  return {.low = heights, .high = heights};
}

CutTarget target_of(const std::vector<SurfaceTriangle>& faces, const Surface& surface, const HeightField& field) {
  HeightField low = *HeightField::create(field.block(), Mm(field.cell()));
  std::vector<bool> is_beside(low.columns() * low.rows(), false);
  for (std::size_t row = 0; row < low.rows(); ++row) {
    for (std::size_t column = 0; column < low.columns(); ++column) {
      const double top = surface.top(low.x_of(column), low.y_of(row));
      low.set_height(column, row, top);
      is_beside[row * low.columns() + column] = top == Surface::nothing;
    }
  }
  HeightField high = low;
  for (const SurfaceTriangle& face : faces) put_highest(face, high);
  return {.low = std::move(low), .high = std::move(high), .at_most = {}, .is_beside = std::move(is_beside)};
}

Cutter thinned(const Cutter& cutter, Mm by) {
  constexpr Mm thinnest{1e-3};
  Cutter thin = cutter;
  thin.radius = std::max(thinnest, cutter.radius - by);
  thin.flat = std::max(Mm(0), cutter.flat - by);
  if (cutter.flat.value() <= 0 && cutter.corner.value() > 0) thin.corner = std::max(thinnest, cutter.corner - by);
  return thin;
}

Mm thinned_tip(const Cutter& cutter, Mm by) {
  const Cutter thin = thinned(cutter, by);
  Mm highest{0};
  constexpr int parts = 64;
  for (int i = 0; i <= parts; ++i) {
    const Mm away = thin.radius * (static_cast<double>(i) / parts);
    highest = std::max(highest, cutter.height(std::min(cutter.radius, away + by)) - thin.height(away));
  }
  return highest;
}

// Half a diagonal, and the chords of arcs.
Mm thinner_for(Mm cell) {
  return cell * 0.81;
}

}  // namespace passo
