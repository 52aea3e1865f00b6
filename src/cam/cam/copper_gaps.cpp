#include "copper_gaps.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "edge_grid.hpp"

namespace passo {
namespace {

EdgeGrid grid_of(const std::vector<Region>& islands, Nanometres cell) {
  std::vector<DrawnPoint> corners;
  for (const Region& island : islands) {
    const DrawnBox box = bounds(island).value_or(DrawnBox{});
    corners.push_back(box.least);
    corners.push_back(box.most);
  }
  EdgeGrid grid(bounds(Region{{corners}}).value_or(DrawnBox{}), cell);
  for (std::uint32_t i = 0; i < islands.size(); ++i) {
    for (const DrawnRing& ring : islands[i].rings) grid.add(ring, i);
  }
  grid.finish();
  return grid;
}

}  // namespace

std::vector<CopperGap> find_gaps(const std::vector<Region>& islands, const std::vector<std::size_t>& group,
                                 Nanometres narrowest, const std::function<bool(DrawnPoint)>& is_milled) {
  const EdgeGrid grid = grid_of(islands, narrowest);
  const auto reach = static_cast<double>(narrowest.count);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<double, DrawnPoint>> best;
  for (std::uint32_t i = 0; i < islands.size(); ++i) {
    for (const DrawnRing& ring : islands[i].rings) {
      for (const DrawnPoint& point : ring) {
        // The least distance of two rings that do not cross is that of a corner of one from an edge of the other.
        grid.for_near(point, point, reach, [&](std::uint32_t index) {
          const EdgeGrid::Edge& edge = grid.edge(index);
          if (edge.owner == i || group[edge.owner] != group[i]) return;
          const EdgeGrid::Near near = EdgeGrid::to_edge(point, edge);
          if (near.distance_nm >= reach) return;
          const DrawnPoint middle{{(point.x.count + near.at.x.count) / 2}, {(point.y.count + near.at.y.count) / 2}};
          const std::pair islands_of_gap(std::min(i, edge.owner), std::max(i, edge.owner));
          const std::pair found(near.distance_nm, middle);
          const auto known = best.find(islands_of_gap);
          if (known != best.end() && known->second <= found) return;
          if (!is_milled || !is_milled(middle)) best[islands_of_gap] = found;
        });
      }
    }
  }
  std::vector<CopperGap> gaps;
  for (const auto& [pair, gap] : best) gaps.push_back({gap.second, {std::llround(gap.first)}, pair.first, pair.second});
  std::ranges::sort(gaps, {}, [](const CopperGap& gap) { return std::pair(gap.width, gap.at); });
  return gaps;
}

Region between_islands(const Region& ground, const std::vector<Region>& islands, Nanometres reach) {
  constexpr Nanometres cell{100'000};
  const EdgeGrid grid = grid_of(islands, cell);
  Region between;
  for (const Region& piece : parts_of(ground)) {
    bool touches_two = false;
    std::optional<std::uint32_t> first;
    for (const DrawnRing& ring : piece.rings) {
      for (const DrawnPoint& point : ring) {
        grid.for_near(point, point, static_cast<double>(reach.count), [&](std::uint32_t index) {
          const EdgeGrid::Edge& edge = grid.edge(index);
          if (touches_two || (first && *first == edge.owner)) return;
          if (EdgeGrid::to_edge(point, edge).distance_nm > static_cast<double>(reach.count)) return;
          touches_two = first.has_value();
          first = edge.owner;
        });
        if (touches_two) break;
      }
    }
    if (touches_two) between.rings.insert(between.rings.end(), piece.rings.begin(), piece.rings.end());
  }
  return between;
}

}  // namespace passo
