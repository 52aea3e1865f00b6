#include "passo/cam/drawing.hpp"

#include <algorithm>

namespace passo {

DrawnPoint lower_left_of(const std::vector<Drawing>& drawings) {
  DrawnPoint corner = {farthest_drawn, farthest_drawn};
  bool is_empty = true;
  const auto take = [&](DrawnPoint at) {
    corner = {std::min(corner.x, at.x), std::min(corner.y, at.y)};
    is_empty = false;
  };
  for (const Drawing& drawing : drawings) {
    for (const DrawnHole& hole : drawing.holes) take(hole.at);
    for (const DrawnPath& path : drawing.paths) {
      if (path.width.count == 0) continue;
      for (const PathPoint& point : path.points) take(point.at);
    }
  }
  return is_empty ? DrawnPoint{} : corner;
}

void move_zero_to(DrawnPoint zero, Drawing& drawing) {
  const auto move = [zero](DrawnPoint& at) { at = {at.x - zero.x, at.y - zero.y}; };
  for (DrawnHole& hole : drawing.holes) move(hole.at);
  for (DrawnPath& path : drawing.paths) {
    for (PathPoint& point : path.points) move(point.at);
  }
}

}  // namespace passo
