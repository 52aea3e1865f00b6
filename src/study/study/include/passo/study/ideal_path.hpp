// IdealPath: the ideal curve of a move, and the tool's position relative to it.
#pragma once

#include <array>

#include "passo/study/step_move.hpp"

namespace passo {

class IdealPath {
 public:
  explicit IdealPath(const StepMove& move);

  double length() const { return length_; }  // steps
  // Returns the point after a fraction `share` (0 … 1) of the path. Axes that the move lacks are 0.
  std::array<double, most_axes> at(double share) const;
  // Returns the fraction of the path before the point nearest to the tool: 0 at the start, 1 at the end. `place` is the
  // current position of the tool. Must be called for each position in order, because on a full circle the result is
  // ambiguous.
  double progress(const Place& place);
  // Returns the distance of `place` from the path, in steps.
  double distance(const Place& place) const;

 private:
  double line_progress(const Place& place) const;
  double arc_progress(const Place& place);

  StepMove move_;
  double length_ = 0;
  double radius_ = 0;
  double sweep_ = 0;      // radians, in the direction of travel
  double travelled_ = 0;  // completed part of the sweep
  Place before_;
};

}  // namespace passo
