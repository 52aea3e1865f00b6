// AxisPolynomial: the motion of one axis in one phase on a line or a cubic, as polynomials of time.
//
// q(s) has degree 3 and s(t) has degree 3, so q(t) has degree 9 at most. With u = t / duration, 0 to 1, a polynomial in
// Bernstein form lies between its smallest and its largest coefficient. So the coefficients tell whether the polynomial
// can exceed a value anywhere. If it can, it is cut in halves (de Casteljau), which have closer bounds. This finds the
// peak, however short, and takes little time for a phase without one.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "exact_curve.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo::proof {

class AxisPolynomial {
 public:
  // `slopes`: the derivatives of the axis at the start of the phase. The duration is above 0.
  AxisPolynomial(const Derivatives& slopes, const Phase& phase);

  enum class Order { velocity = 1, acceleration = 2, jerk = 3 };
  struct Peak {
    double value = 0;  // an absolute value
    double u = 0;
  };
  // Returns the largest absolute value in the phase, if it is above `least`.
  std::optional<Peak> peak_above(double least, Order order) const;
  // Returns an upper bound of the absolute values in the phase.
  double highest(Order order) const;
  double value(double u, Order order) const;

 private:
  static constexpr std::size_t most_terms = 10;
  using Terms = std::array<double, most_terms>;

  std::array<Terms, 4> terms_{};  // of each derivative by time, from the lowest power of u on
  std::size_t count_ = 0;         // of the terms of q; each derivative has one fewer
};

}  // namespace passo::proof
