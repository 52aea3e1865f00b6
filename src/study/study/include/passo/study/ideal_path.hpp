// IdealPath: the curve that the pulses stand for, and the tool's place relative to it.
#pragma once

#include <array>

#include "passo/study/step_move.hpp"

namespace passo {

class IdealPath {
 public:
  explicit IdealPath(const StepMove& move);

  double length() const { return length_; }  // steps
  // The point after `share` (0 … 1) of the path. Axes that the move lacks are 0.
  std::array<double, most_axes> at(double share) const;
  // The share of the path before the tool's foot on it: 0 at the start, 1 at the end. `place` is the tool's present
  // place. Call this for each place in turn, because a full circle has more than one answer.
  double progress(const Place& place);
  // The distance of `place` from the path, in steps.
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
