// groups_apart: finds groups of rings that cannot touch each other, so that each group can be combined or offset
// separately. A sweep over a group takes time proportional to its corners times the edges beside them: many small
// sweeps are faster than one large sweep, and need less memory. Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

// Disjoint sets of indices. The representative of a group is its smallest index.
class IndexGroups {
 public:
  explicit IndexGroups(std::size_t count);
  std::size_t of(std::size_t index);
  void join(std::size_t a, std::size_t b);

 private:
  std::vector<std::size_t> up_;  // the parent of each index, as a forest
};

// Returns the groups of connected boxes as indices in ascending order, sorted by their first index. Boxes of different
// groups are more than `reach` apart. If there are too many boxes to separate them quickly, all of them form one group.
std::vector<std::vector<std::size_t>> groups_apart(const std::vector<DrawnBox>& boxes, Nanometres reach);

// Returns all regions as one region. They must not touch each other.
Region gathered(const std::vector<Region>& apart);

}  // namespace passo
