// ThreadingCycle: G76, a thread cut in passes along Z, as operations.
//
// Depths count from the thread's crest. Pass n goes J * n^(1/R) deep, the last ones (with H spring passes) K. With Q
// the tool follows the thread's flank: the deeper, the further back along Z it starts. E and L let the tool in and out
// on a slope, on which the pitch grows so that along the slope the turns stay as far apart. Millimetres.
#pragma once

#include <cstdint>

#include "cycle.hpp"

namespace passo {

struct ThreadingPlan {
  Point start;
  Point end;           // the place after the last pass
  double outward = 1;  // along X, away from the thread: 1 outside, -1 inside
  // From the start to the thread's crest (I), of the first pass (J) and of the last (K), in the program's units: what
  // a pass is compared in, so that it is rounded as in LinuxCNC.
  double crest = 0;
  double first_cut = 0;
  double full_depth = 0;
  double unit = 1;                 // of these, in millimetres along X
  double pitch = 0;                // P
  double infeed_tangent = 0;       // of Q, the compound slide's angle; its sign is the cut's direction
  double degression = 1;           // R
  std::int32_t spring_passes = 0;  // H
  double taper = 0;                // E, along Z in the cut's direction
  bool taper_at_start = false;
  bool taper_at_end = false;
  bool feed_override = true;  // whether the override is on, and is on again after each pass
};

class ThreadingCycle final : public Cycle {
 public:
  ThreadingCycle(const ThreadingPlan& plan, const OperationSource& source)
      : Cycle(plan.start, source), plan_(plan), springs_left_(plan.spring_passes) {}

 private:
  bool step() override;
  void cut(double depth);

  ThreadingPlan plan_;
  std::int32_t pass_ = 1;
  std::int32_t springs_left_;
  bool full_depth_reached_ = false;
};

}  // namespace passo
