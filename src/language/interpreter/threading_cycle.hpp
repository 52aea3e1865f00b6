// ThreadingCycle: G76, a thread cut in passes along Z, as operations.
//
// Depths are measured from the thread's crest. Pass n is J * n^(1/R) deep. The last pass and H spring passes are K
// deep. With Q the tool follows the thread's flank: the deeper a pass, the farther its start and end are shifted in the
// direction of the cut. E and L define tapered entry and exit moves. On the taper the feed per revolution is larger, so
// that the thread's pitch along Z stays constant. Lengths are in millimetres.
#pragma once

#include <cstdint>

#include "cycle.hpp"

namespace passo {

struct ThreadingPlan {
  Point start;
  Point end;           // its Z is the end of the thread; the tool position after the last pass
  double outward = 1;  // direction along X away from the thread: 1 for an external thread, -1 for an internal thread
  // The following three are in the program's units, in which depths are compared, so that they are rounded as in
  // LinuxCNC.
  double crest = 0;                // I, from the start to the thread's crest
  double first_cut = 0;            // J, depth of the first pass
  double full_depth = 0;           // K, depth of the last pass
  double unit = 1;                 // millimetres along X per unit
  double pitch = 0;                // P
  double infeed_tangent = 0;       // tangent of Q, the compound slide angle; negated if the cut goes towards higher Z
  double degression = 1;           // R
  std::int32_t spring_passes = 0;  // H
  double taper = 0;                // E, length of the taper along Z; negated if the cut goes towards higher Z
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
