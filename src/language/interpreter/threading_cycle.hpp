// ThreadingCycle: G76, a thread cut in passes along Z, as operations.
//
// Depths count from the thread's crest. Pass n goes J * n^(1/R) deep. The last pass and H spring passes go K deep. With
// Q the tool follows the thread's flank: the deeper a pass, the further along the cut's direction it starts and ends. E
// and L lead the tool in and out on a slope. On the slope the feed for a revolution is larger, so that along Z the
// turns stay equally far apart. Lengths are in millimetres.
#pragma once

#include <cstdint>

#include "cycle.hpp"

namespace passo {

struct ThreadingPlan {
  Point start;
  Point end;           // its Z is the thread's end; the tool's position after the last pass
  double outward = 1;  // the way along X away from the thread: 1 for an outside thread, -1 for an inside thread
  // These three are in the program's units. Depths are compared in these units, so that they are rounded as in
  // LinuxCNC.
  double crest = 0;                // I, from the start to the thread's crest
  double first_cut = 0;            // J, the depth of the first pass
  double full_depth = 0;           // K, the depth of the last pass
  double unit = 1;                 // millimetres along X in one of these units
  double pitch = 0;                // P
  double infeed_tangent = 0;       // tangent of Q, the compound slide's angle; negated if the cut goes towards higher Z
  double degression = 1;           // R
  std::int32_t spring_passes = 0;  // H
  double taper = 0;                // E, the slope's length along Z; negated if the cut goes towards higher Z
  bool taper_at_start = false;
  bool taper_at_end = false;
  bool feed_override = true;  // whether the override was on: it is switched on again after each pass
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
