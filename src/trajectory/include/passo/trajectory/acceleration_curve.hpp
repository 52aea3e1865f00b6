// AccelerationCurve: how the acceleration that an axis may have falls with its speed.
//
// Given are samples of a falling function A(v). Kept is a convex function of w = v² below them, as the highest of a few
// straight lines at_rest − fall·w. In w, because the planner's demands are linear in squares of speeds: each of the
// lines is a demand that keeps to the curve wherever the speed really is, and the one that is highest at that speed
// gives hardly anything away (speed_window.hpp).
//
//   A ^ ......                 ...  the samples: flat up to a shoulder, then falling
//     |    \  `.               \    the lines; left of the shoulder they are above the constant limit that
//     |     \__ `.                  every axis has besides, and do not matter
//     |        `---\____
//     +-------------------> w
//
// What the samples promise where they are concave beyond the shoulder is lost: the chord below it counts.
//
// Invariant: falls are not negative and descending, so that line after line is the highest. Without lines it does not
// limit.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "passo/units/units.hpp"

namespace passo {

class AccelerationCurve {
 public:
  struct Sample {
    MmPerSecond speed{0};
    MmPerSecond2 acceleration{0};
  };
  struct Line {
    double at_rest = 0;  // mm/s²
    double fall = 0;     // mm/s² for each (mm/s)²

    double at(double w) const { return at_rest - fall * w; }
  };

  AccelerationCurve() = default;
  // Nowhere above any falling function through the samples, whose speeds ascend from 0 and whose accelerations fall
  // and stay above 0. `most`: the constant limit beside it; where the samples are above it they are not needed.
  static AccelerationCurve below(std::span<const Sample> samples, MmPerSecond2 most);

  bool empty() const { return lines_.empty(); }
  // Up to this w the constant limit counts alone; only where there are lines.
  double shoulder() const { return shoulder_; }
  // The highest line at w, by number; lines() is not empty.
  std::size_t line_at(double w) const;
  const std::vector<Line>& lines() const { return lines_; }
  MmPerSecond2 at(MmPerSecond speed) const;

 private:
  void add(const Line& line, double w);

  std::vector<Line> lines_;
  std::vector<double> ends_;  // of all lines but the last: the w from where the next one is higher
  double shoulder_ = 0;
};

}  // namespace passo
