// finish_run: one lap of a cutter along a wall at full depth, after roughing. Private to cam/.
#pragma once

#include <cstdint>
#include <functional>

#include "closed_toolpath.hpp"

namespace passo {

struct FinishPass {
  Nanometres depth = {};
  Nanometres floor = {};  // left by roughing beside the wall
  double lead_nm = 0;     // radius of the arcs in and out, made smaller where there is no room
  bool climb = true;
  std::uint32_t spring_passes = 0;
  std::function<bool(DrawnPoint)> is_cut = {};                        // whether the cutter may plunge there
  std::function<bool(DrawnPoint, DrawnPoint, double)> is_clear = {};  // whether it may move along this line or arc
};

// Quarter circles lead to the track and away from it, within the cleared area. The lap begins where there is no tab.
MillRun finish_run(const ClosedToolpath& track, const FinishPass& pass);

// Marks the moves that cut, from this point of the run on, as finishing.
void mark_finish(MillRun& run, std::size_t from);

}  // namespace passo
