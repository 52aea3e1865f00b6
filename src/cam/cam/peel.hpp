// peel: clears a region with a limited radial engagement of the cutter. Private to cam/.
//
// The region is that of the cutter centre. It is the union of the largest discs about the points of its medial axis.
// The cutter descends along a helix in the centre of the largest disc, and widens the hole to that disc in a spiral.
// From there discs are cleared along all branches of the axis. Each next disc is the farthest whose rim the cutter can
// follow within the engagement limit when the previous disc is clear; earlier discs can only reduce the engagement.
// Parts of a rim that lie in earlier discs are skipped. Finally, the cutter follows the walls.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct PeelOptions {
  Nanometres cutter{3'000'000};  // cutter diameter
  double most_degrees = 60;      // maximum engagement
  bool climb = true;
};

// A part of a run: its points from `first` to `last`.
struct PeelLap {
  std::size_t run = 0;
  std::size_t first = 0;
  std::size_t last = 0;
};

struct PeelWay {
  MillRun entry = {};              // the last turn of the helix, a full circle
  std::vector<MillRun> runs = {};  // all at Z0; the first one continues at the end of the entry
  std::vector<PeelLap> laps = {};  // laps along the walls
  std::size_t discs = 0;           // number of discs whose rims are followed
  bool is_whole = false;
};

// Returns half the width of the narrowest area of the cutter centre that is cleared. In narrower areas the cutter would
// cut a slot.
inline Nanometres least_peeled(Nanometres cutter) {
  return {(cutter.count + 19) / 20};
}

// Clears `ground`: one part, everywhere at least twice `least_peeled` wide. The result is incomplete if the toolpath
// would exceed `longest_peel` cutter radii or if the area is wider than 4 m.
inline constexpr double longest_peel = 500'000;
PeelWay peel(const Region& ground, const PeelOptions& options, const WorkProgress& progress = {});

}  // namespace passo
