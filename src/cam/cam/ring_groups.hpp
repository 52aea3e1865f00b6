// groups_apart: which rings cannot meet, so that each group can be combined or grown on its own. The time of a sweep
// over a group is its corners times the edges beside them: many small sweeps are faster than one, and need less memory.
// Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

// Which indices hang together. A group is named after its least index.
class IndexGroups {
 public:
  explicit IndexGroups(std::size_t count);
  std::size_t of(std::size_t index);
  void join(std::size_t a, std::size_t b);

 private:
  std::vector<std::size_t> up_;  // a forest
};

// The indices of boxes that hang together, in rising order; groups in the order of their first. Boxes of two groups are
// more than `reach` apart. Boxes so many that telling them apart takes long are one group.
std::vector<std::vector<std::size_t>> groups_apart(const std::vector<DrawnBox>& boxes, Nanometres reach);

// The same of rings, which do not cross each other, by their edges: a ring around others is apart from them
// if its edges are. Takes longer.
std::vector<std::vector<std::size_t>> groups_of_edges_apart(const Region& region, Nanometres reach);

}  // namespace passo
