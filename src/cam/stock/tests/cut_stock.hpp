// A block of stock, tools, and moves that cut it, for the tests of stock/.
#pragma once

#include <vector>

#include "passo/geometry/curve.hpp"
#include "passo/stock/stock_cutter.hpp"

namespace passo::test {

inline Point point_at(double x, double y, double z) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  point[Axis::z] = z;
  return point;
}

inline ToolShape flat_tool(double diameter) {
  return {.cutter = Cutter::flat_end(Mm(diameter))};
}
inline ToolShape ball_tool(double diameter) {
  return {.cutter = Cutter::ball(Mm(diameter))};
}

inline HeightField field_of(const StockBlock& block, double cell) {
  Result<HeightField, FieldRefusal> field = HeightField::create(block, Mm(cell));
  return *field;
}

// Collects the effect of each move.
class CutBlock {
 public:
  CutBlock(const StockBlock& block, double cell, const StockCutterOptions& options)
      : field(field_of(block, cell)), cutter(field, options, [this](const MoveCut& cut) { cuts.push_back(cut); }) {}

  void line(const Point& from, const Point& to, const StockMove& move = {}) {
    cutter.cut(Curve::line(from, to), {}, move);
  }

  HeightField field;
  std::vector<MoveCut> cuts;
  StockCutter cutter;
};

}  // namespace passo::test
