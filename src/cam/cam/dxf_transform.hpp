// DxfTransform: how the places of a block lie in the drawing. Private to cam/.
//
//     x' = xx x + xy y + dx,   y' = yx x + yy y + dy
#pragma once

#include <cmath>

namespace passo {

struct DxfTransform {
  double xx = 1;
  double xy = 0;
  double yx = 0;
  double yy = 1;
  double dx = 0;
  double dy = 0;

  double x(double px, double py) const { return xx * px + xy * py + dx; }
  double y(double px, double py) const { return yx * px + yy * py + dy; }
  bool is_mirrored() const { return xx * yy - xy * yx < 0; }
  // The factor on lengths, if it is the same in all directions; else 0.
  double uniform_scale() const {
    const double a = std::hypot(xx, yx);
    const double b = std::hypot(xy, yy);
    const double lean = std::abs(xx * xy + yx * yy);
    return std::abs(a - b) <= 1e-9 * (a + b) && lean <= 1e-9 * a * b ? a : 0;
  }
  // An upper bound of the factor on lengths.
  double largest_scale() const { return std::hypot(std::hypot(xx, yx), std::hypot(xy, yy)); }

  // First `inner`, then this.
  DxfTransform after(const DxfTransform& inner) const {
    return {xx * inner.xx + xy * inner.yx, xx * inner.xy + xy * inner.yy, yx * inner.xx + yy * inner.yx,
            yx * inner.xy + yy * inner.yy, x(inner.dx, inner.dy),         y(inner.dx, inner.dy)};
  }
};

}  // namespace passo
