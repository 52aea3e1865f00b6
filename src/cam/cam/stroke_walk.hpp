// walk_strokes: converts lines that meet at nodes to runs of the cutter; cuts each line once. Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/mill_plan.hpp"

namespace passo {

// A line from one node to another.
struct CutterStroke {
  std::size_t from = 0;
  std::size_t to = 0;
  MillRun points = {};  // at least two
};

// Returns the runs; those of connected strokes follow each other. The rapids between them are shortened, from the park
// position and back. At a node the cutter continues as straight as possible. `nodes`: number of nodes; all node indices
// are smaller.
std::vector<MillRun> walk_strokes(std::vector<CutterStroke> strokes, std::size_t nodes, DrawnPoint park);

}  // namespace passo
