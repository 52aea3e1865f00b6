// Projection: maps a point of the path to a point of the picture, at the same scale in all directions. Private to
// report/.
#pragma once

#include <algorithm>

#include "canvas.hpp"

#include "passo/geometry/axes.hpp"
#include "passo/geometry/curve.hpp"

namespace passo {

class Projection {
 public:
  // Views along the third axis: `across` points right, `up` points up. Both are X, Y or Z.
  static Projection flat(Axis across, Axis up) {
    const auto way = [&](Axis axis) { return Spot{axis == across ? 1.0 : 0.0, axis == up ? 1.0 : 0.0}; };
    return {way(Axis::x), way(Axis::y), way(Axis::z)};
  }
  // Views from the front, right and above. All axes are equally foreshortened: X points right and down, Y right and up.
  //
  //            back
  //     left  /    \        Z
  //        |\/      \/right  |  / Y
  //        | \     / |       | /
  //           front          |/ \ X
  static Projection isometric() {
    constexpr double cosine = 0.8660254037844386;
    return {{cosine, -0.5}, {cosine, 0.5}, {0, 1}};
  }

  // Fits the whole box into the middle of `area`, as large as possible.
  void fit(const Box& box, const Area& area);

  Spot spot(double x, double y, double z) const {
    return {left_ + scale_ * (x_.x * x + y_.x * y + z_.x * z), top_ - scale_ * (x_.y * x + y_.y * y + z_.y * z)};
  }
  Spot spot(const Point& point) const { return spot(point[Axis::x], point[Axis::y], point[Axis::z]); }
  // Returns the picture units per millimetre along an axis.
  double scale() const { return scale_; }

 private:
  Projection(Spot x, Spot y, Spot z) : x_(x), y_(y), z_(z) {}

  // The displacement in the picture per millimetre of each axis, at scale 1. Here y points up.
  Spot x_;
  Spot y_;
  Spot z_;
  double scale_ = 1;
  double left_ = 0;
  double top_ = 0;
};

inline void Projection::fit(const Box& box, const Area& area) {
  *this = Projection(x_, y_, z_);
  Spot low = spot(box.low);
  Spot high = low;
  for (unsigned corner = 1; corner < 8; ++corner) {
    const auto side = [&](Axis axis, unsigned bit) { return (corner & bit) != 0 ? box.high[axis] : box.low[axis]; };
    const Spot at = spot(side(Axis::x, 1), side(Axis::y, 2), side(Axis::z, 4));
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  }
  scale_ = std::min(area.width / (high.x - low.x), area.height / (high.y - low.y));
  left_ = area.x + area.width / 2 - scale_ * (low.x + high.x) / 2;
  top_ = area.y + area.height / 2 - scale_ * (low.y + high.y) / 2;
}

}  // namespace passo
