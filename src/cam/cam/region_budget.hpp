// RegionBudget: how much uniting rings may still cost. A hostile file crosses its lines so often that no computer could
// unite them; the budget knows before it is tried. Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

class RegionBudget {
 public:
  // `share`: of what a layer may cost.
  explicit RegionBudget(double share = 1)
      : crossings_(part_of(4e6, share)), comparisons_(part_of(4e8, share)), passed_(part_of(1e9, share)) {}

  // Whether these rings can be united; then what that costs is spent. Costs are crossings of edges, and how many edges
  // a sweep over all corners passes.
  bool affords(const std::vector<const DrawnRing*>& rings);
  bool affords(const std::vector<Region>& regions);
  bool affords(const std::vector<DrawnRing>& rings);

 private:
  static std::size_t part_of(double all, double share) { return static_cast<std::size_t>(all * share); }
  bool spend(std::size_t cost, std::size_t& left);

  std::size_t crossings_;
  std::size_t comparisons_;
  std::size_t passed_;
};

}  // namespace passo
