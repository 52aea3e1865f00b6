// G76: a thread cut in passes along Z. Where the passes are, from the cycle's words. Millimetres.
#pragma once

#include <cstdint>

#include "passo/geometry/axes.hpp"

namespace passo {

struct ThreadingCycle {
  Point start;
  Point end;                       // behind the last pass
  double outward = 1;              // along X, away from the thread: 1 outside, -1 inside
  double crest = 0;                // I: from the start to the thread's crest
  double first_cut = 0;            // J
  double full_depth = 0;           // K
  double pitch = 0;                // P
  double infeed_tangent = 0;       // of Q, the compound slide's angle; its sign is the cut's direction
  double degression = 1;           // R
  std::int32_t spring_passes = 0;  // H
  double taper = 0;                // E, along Z in the cut's direction
  bool taper_at_start = false;
  bool taper_at_end = false;

  std::int32_t pass = 1;
  bool full_depth_reached = false;
};

}  // namespace passo
