// IdealPath: the curve that the pulses stand for, and where the tool is beside it.
#pragma once

#include <array>

#include "passo/study/step_move.hpp"

namespace passo {

class IdealPath {
 public:
  explicit IdealPath(const StepMove& move);

  double length() const { return length_; }  // steps
  // The point after a share of the path, 0 … 1; axes that the move lacks are 0.
  std::array<double, most_axes> at(double share) const;
  // The tool stands at `place` now; called for each place in turn, for a full circle has more than one answer.
  // How much of the path lies behind the tool's foot on it, 0 at the start, 1 at the end.
  double progress(const Place& place);
  // Distance from the path, steps.
  double distance(const Place& place) const;

 private:
  double line_progress(const Place& place) const;
  double arc_progress(const Place& place);

  StepMove move_;
  double length_ = 0;
  double radius_ = 0;
  double sweep_ = 0;      // radians, in the sense of travel
  double travelled_ = 0;  // of the sweep
  Place before_;
};

}  // namespace passo
