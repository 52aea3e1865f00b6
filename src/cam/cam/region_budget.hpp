// RegionBudget: limits the cost of uniting rings. A malicious file can cross its lines so often that uniting them would
// take forever; the budget estimates the cost beforehand. Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

class RegionBudget {
 public:
  // `share`: fraction of the maximum cost of a layer.
  explicit RegionBudget(double share = 1)
      : crossings_(part_of(4e6, share)), comparisons_(part_of(4e8, share)), passed_(part_of(1e9, share)) {}

  // Returns whether the budget suffices to unite these rings, and if so, deducts the cost. Costs are the crossings of
  // edges, and the number of edges that a sweep over all corners passes.
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
