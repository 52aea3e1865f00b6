// RegionBudget: how much uniting rings may still cost. A hostile file crosses its lines so often that no computer could
// unite them; the budget knows before it is tried. Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

class RegionBudget {
 public:
  // Whether these rings can be united; then what that costs is spent. Costs are crossings of edges, and how many edges
  // a sweep over all corners passes.
  bool affords(const std::vector<const DrawnRing*>& rings);
  bool affords(const std::vector<Region>& regions);
  bool affords(const std::vector<DrawnRing>& rings);

 private:
  bool spend(std::size_t cost, std::size_t& left);

  std::size_t crossings_ = 4'000'000;
  std::size_t comparisons_ = 400'000'000;
  std::size_t passed_ = 1'000'000'000;
};

}  // namespace passo
