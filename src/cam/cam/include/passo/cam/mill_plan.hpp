// MillPlan: where milling cutters go, as runs: down into the board, along a way, and up again.
#pragma once

#include <string>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

// A place of the middle of the cutter. The bulge tells how the cutter goes on from there, as in PathPoint; the height
// changes evenly on the way. Z0 is the face of the board.
struct MillPoint {
  DrawnPoint at = {};
  double bulge = 0;
  Nanometres z = {};
};

using MillRun = std::vector<MillPoint>;  // two points or more

struct MillTool {
  Nanometres width = {};           // that it mills at the face of the board; where its depth changes, its tip
  std::string words = {};          // for the operator: "cutter 1 mm"
  std::vector<MillRun> runs = {};  // in the order in which they are made
};

struct MillPlan {
  std::vector<MillTool> tools = {};     // in the order in which they are used; without those that do nothing
  std::vector<std::string> notes = {};  // what was changed or left out, a sentence each without a full stop
};

struct MillLengths {
  std::size_t runs = 0;  // and so many times the cutter goes down
  double milled_nm = 0;
  double rapids_nm = 0;  // beside the board, from the park place and back, for each tool
};

MillLengths lengths_of(const MillTool& tool, DrawnPoint park);

// The middle of the cutter on its way, as chords within the tolerance.
std::vector<DrawnPoint> chords_of(const MillRun& run, Nanometres tolerance);

}  // namespace passo
