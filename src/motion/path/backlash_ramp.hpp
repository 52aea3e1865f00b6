// BacklashRamp: the fraction of the backlash that is taken up, which grows from 0 to 1 along a piece of the path.
//
// The second derivative is constant in each of two parts, or, where it must be continuous, a triangle in each of them:
// it rises from 0 to its peak in the first half of a part and falls to 0 in the second. Between two knots the fraction
// is a cubic of s. Private to path/.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "passo/path/path_smoother.hpp"

namespace passo {

class BacklashRamp {
 public:
  // From s = `begin` to `end`; between `begin` and `middle` the slope grows. begin < middle < end.
  BacklashRamp(double begin, double middle, double end, Smoothness smoothness);

  double at(double s) const;
  double slope(double s) const;
  double second_derivative(double s) const;
  // The positions at which the polynomial changes, including both ends.
  std::span<const double> knots() const { return {knots_.data(), count_}; }

 private:
  struct Local {  // between two knots
    double from = 0;
    double value = 0;
    double slope = 0;
    double bend = 0;  // second derivative at `from`, and its slope
    double twist = 0;
  };
  Local at_knot_before(double s) const;

  std::array<double, 5> knots_{};
  std::array<Local, 5> pieces_{};
  std::size_t count_ = 0;
};

}  // namespace passo
