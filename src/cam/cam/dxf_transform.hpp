// DxfTransform: maps the coordinates of a block to those of the drawing. Private to cam/.
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

  friend bool operator==(const DxfTransform&, const DxfTransform&) = default;
  double x(double px, double py) const { return xx * px + xy * py + dx; }
  double y(double px, double py) const { return yx * px + yy * py + dy; }
  bool is_mirrored() const { return xx * yy - xy * yx < 0; }
  // Returns the scale factor if it is the same in all directions, otherwise 0.
  double uniform_scale() const {
    const double a = std::hypot(xx, yx);
    const double b = std::hypot(xy, yy);
    const double lean = std::abs(xx * xy + yx * yy);
    return std::abs(a - b) <= 1e-9 * (a + b) && lean <= 1e-9 * a * b ? a : 0;
  }
  // Returns an upper bound of the scale factor.
  double largest_scale() const { return std::hypot(std::hypot(xx, yx), std::hypot(xy, yy)); }

  // Returns the transform that applies `inner` first and then this one.
  DxfTransform after(const DxfTransform& inner) const {
    return {xx * inner.xx + xy * inner.yx, xx * inner.xy + xy * inner.yy, yx * inner.xx + yy * inner.yx,
            yx * inner.xy + yy * inner.yy, x(inner.dx, inner.dy),         y(inner.dx, inner.dy)};
  }
};

}  // namespace passo
