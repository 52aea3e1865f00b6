// peel: the way of a cutter that clears a region without ever having more than a given angle of its edge in the stock.
// Private to cam/.
//
// The region is that of the cutter's middle. It is the union of the discs about the points of its medial axis that just
// fit into it. The cutter goes down in the middle of the largest one along a helix, and widens the hole in a spiral to
// that disc. From there discs go along all branches of the axis. Each next one is the farthest whose rim the cutter can
// follow within the angle when the ground of the disc before is free; other discs before only make it less. What of a
// rim lies in earlier discs is not followed. At last the cutter goes along the walls.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct PeelOptions {
  Nanometres cutter{3'000'000};  // diameter
  double most_degrees = 60;      // of engagement
  bool climb = true;
};

// A part of a run: its points from `first` to `last`.
struct PeelLap {
  std::size_t run = 0;
  std::size_t first = 0;
  std::size_t last = 0;
};

struct PeelWay {
  MillRun entry = {};              // the lowest lap of the helix, a full turn
  std::vector<MillRun> runs = {};  // all at Z0; the first goes on where the entry ends
  std::vector<PeelLap> laps = {};  // along the walls
  std::size_t discs = 0;           // whose rims are followed
  bool is_whole = false;
};

// Half of the width of the narrowest ground of the cutter's middle that is peeled. In narrower ground the cutter would
// be in a slot.
inline Nanometres least_peeled(Nanometres cutter) {
  return {(cutter.count + 19) / 20};
}

// `ground`: one part, at least twice `least_peeled` wide everywhere. Not whole: the way would be longer than
// `longest_peel` radii of the cutter, or the ground is wider than 4 m.
inline constexpr double longest_peel = 500'000;
PeelWay peel(const Region& ground, const PeelOptions& options, const WorkProgress& progress = {});

}  // namespace passo
