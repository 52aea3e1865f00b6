// Closed contours for tests, in mm: polygons, boxes, circles.
#pragma once

#include <vector>

#include "passo/cam/bulge.hpp"
#include "passo/cam/drawing.hpp"

namespace passo::test {

using PathPoints = std::vector<PathPoint>;

inline PathPoint corner(double x, double y, double bulge = 0) {
  return {{to_nanometres(Mm(x)), to_nanometres(Mm(y))}, bulge};
}
inline PathPoints box(double x, double y, double width, double height) {
  return {corner(x, y), corner(x + width, y), corner(x + width, y + height), corner(x, y + height)};
}
inline PathPoints circle(double x, double y, double radius) {
  return {corner(x + radius, y, 1), corner(x - radius, y, 1)};
}

}  // namespace passo::test
