#include "nested_loops.hpp"

#include <algorithm>

#include "passo/cam/edge_loops.hpp"

namespace passo {

std::vector<NestedLoop> nest(const std::vector<std::vector<PathPoint>>& loops, Nanometres tolerance) {
  std::vector<NestedLoop> nested;
  std::vector<DrawnBox> boxes;
  for (const std::vector<PathPoint>& loop : loops) {
    Region inside = filled({chords_of_path(loop, true, tolerance)});
    if (inside.empty()) continue;
    boxes.push_back(*bounds(inside));
    nested.push_back({std::move(inside)});
  }
  for (std::size_t i = 0; i < nested.size(); ++i) {
    const DrawnPoint point = nested[i].inside.rings.front().front();
    for (std::size_t other = 0; other < nested.size(); ++other) {
      const DrawnBox& box = boxes[other];
      const bool is_in_box = box.least.x <= boxes[i].least.x && box.least.y <= boxes[i].least.y &&
                             boxes[i].most.x <= box.most.x && boxes[i].most.y <= box.most.y;
      if (other != i && is_in_box && contains(nested[other].inside, point)) ++nested[i].around;
    }
  }
  return nested;
}

std::size_t deepest_of(const std::vector<NestedLoop>& loops) {
  std::size_t deepest = 0;
  for (const NestedLoop& loop : loops) deepest = std::max(deepest, loop.around);
  return deepest;
}

Region filled_at(const std::vector<NestedLoop>& loops, std::size_t around) {
  std::vector<Region> regions;
  for (const NestedLoop& loop : loops) {
    if (loop.around == around) regions.push_back(loop.inside);
  }
  return united(regions);
}

Region filled_in_turn(const std::vector<NestedLoop>& loops) {
  Region all;
  for (std::size_t around = 0; around <= deepest_of(loops); ++around) {
    const Region here = filled_at(loops, around);
    all = around % 2 == 0 ? united(all, here) : subtracted(all, here);
  }
  return all;
}

Region enclosed_by(const std::vector<std::vector<PathPoint>>& loops) {
  return filled_in_turn(nest(loops, {500}));
}

Region notable_part(const Region& region, Nanometres least) {
  return grown(grown(region, {-least.count}), least);
}

}  // namespace passo
