#include "passo/cam/mirror.hpp"

#include <algorithm>

namespace passo {

DrawnPoint mirrored(DrawnPoint point, const Mirror& mirror) {
  if (mirror.turned == Mirror::Turned::x) return {{2 * mirror.at.count - point.x.count}, point.y};
  if (mirror.turned == Mirror::Turned::y) return {point.x, {2 * mirror.at.count - point.y.count}};
  return point;
}

Region mirrored(const Region& region, const Mirror& mirror) {
  Region result = region;
  if (mirror.turned == Mirror::Turned::no) return result;
  for (DrawnRing& ring : result.rings) {
    for (DrawnPoint& point : ring) point = mirrored(point, mirror);
    std::ranges::reverse(ring);
  }
  return result;
}

void mirror_drawing(Drawing& drawing, const Mirror& mirror) {
  if (mirror.turned == Mirror::Turned::no) return;
  for (DrawnHole& hole : drawing.holes) hole.at = mirrored(hole.at, mirror);
  for (DrawnPath& path : drawing.paths) {
    for (PathPoint& point : path.points) point = {mirrored(point.at, mirror), -point.bulge};
  }
}

}  // namespace passo
