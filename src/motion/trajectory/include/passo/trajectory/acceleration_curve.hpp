// AccelerationCurve: the acceleration limit of an axis, which falls with its speed.
//
// The input is samples of a falling function A(v). The stored curve is a convex function of w = v² below the samples:
// the maximum of a few straight lines at_rest − fall·w. It is a function of w because the planner's constraints are
// linear in squared speeds. Each line is thus a constraint that holds at any speed, and the highest line at the present
// speed is almost exact (speed_window.hpp).
//
//   A ^ ......                 ...  the samples: flat up to a shoulder, then falling
//     |    \  `.               \    the lines; left of the shoulder they are above the constant limit that
//     |     \__ `.                  every axis also has, and so have no effect
//     |        `---\____
//     +-------------------> w
//
// Where the samples are concave beyond the shoulder, the curve is the chord below them, so some acceleration is lost.
//
// Invariant: the falls are not negative and descend from line to line, so each line in turn is the highest. A curve
// without lines does not limit.
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
  // Returns a curve that is nowhere above a falling function through the samples. The speeds of the samples ascend from
  // 0; their accelerations fall and stay above 0. `most` is the constant limit that applies besides the curve; samples
  // above it are not needed.
  static AccelerationCurve below(std::span<const Sample> samples, MmPerSecond2 most);

  bool empty() const { return lines_.empty(); }
  // Up to this w only the constant limit applies. Call it only if there are lines.
  double shoulder() const { return shoulder_; }
  // The number of the highest line at w. lines() must not be empty.
  std::size_t line_at(double w) const;
  const std::vector<Line>& lines() const { return lines_; }
  MmPerSecond2 at(MmPerSecond speed) const;
  // Those w from `low` to `high` at which the next line becomes the highest. lines() must not be empty.
  std::span<const double> bends_between(double low, double high) const;

 private:
  void add(const Line& line, double w);

  std::vector<Line> lines_;
  std::vector<double> ends_;  // for all lines but the last: the w from which the next line is higher
  double shoulder_ = 0;
};

}  // namespace passo
