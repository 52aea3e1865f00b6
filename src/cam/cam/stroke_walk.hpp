// walk_strokes: lines that meet at nodes become runs of the cutter, each line cut once. Private to cam/.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/mill_plan.hpp"

namespace passo {

// A line from one node to another.
struct CutterStroke {
  std::size_t from = 0;
  std::size_t to = 0;
  MillRun points = {};  // two or more
};

// Of what hangs together the runs follow each other; the way between is shortened from the park place and back to it.
// At a node the cutter goes on as straight as it can. `nodes`: more than every node's number.
std::vector<MillRun> walk_strokes(std::vector<CutterStroke> strokes, std::size_t nodes, DrawnPoint park);

}  // namespace passo
