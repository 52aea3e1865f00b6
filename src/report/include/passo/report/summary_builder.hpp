// SummaryBuilder: watches the motion as it passes and adds it up. Constant memory.
//
// About 70 ns a line, 1.3 µs an arc. Extents are exact. The peaks of an axis are exact for lines; on arcs, where the
// pull to the centre and the change of speed add up at an angle, they are found by bisection and lie at most 0.1 %
// below the true peak.
#pragma once

#include <memory>
#include <vector>

#include "passo/report/summary.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class SummaryBuilder {
 public:
  // `axes` of the machine, in the order in which they are shown.
  explicit SummaryBuilder(std::vector<Axis> axes);
  ~SummaryBuilder();

  // `machine_minus_work`: the work frame at this item, as an offset (a frame that is turned about Z has none: the work
  // extents are then those of the offset alone).
  void watch(const MotionItem& item, const Point& machine_minus_work);

  // The motion's part; names and board are left to the caller.
  RunSummary summary() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
