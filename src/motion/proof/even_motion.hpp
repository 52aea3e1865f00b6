// EvenMotion: the motion of one axis in one phase of constant acceleration on a line or a cubic, in closed form.
//
// With x = ṡ² = v₀² + 2 a σ, and q'(σ) = p₁ + p₂ σ + p₃ σ²/2 from the start of the phase on:
//
//   q̇² = q'² x           its slope is 2 q' q̈
//   q̈  = q' a + q'' x    a parabola of σ
//   q⃛  = ṡ (q''' x + 3 q'' a)
//
// So all peaks lie at roots of polynomials of degree 1 and 2.
#pragma once

#include <optional>

#include "axis_polynomial.hpp"
#include "exact_curve.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo::proof {

class EvenMotion {
 public:
  using Order = AxisPolynomial::Order;
  struct Peak {
    double value = 0;  // an absolute value
    double time = 0;   // since the start of the phase
  };

  // `slopes`: the derivatives of the axis at the start of the phase, which has a duration above 0 and no jerk.
  EvenMotion(const Derivatives& slopes, const Phase& phase);

  // Returns the largest absolute value in the phase, if it is above `least`.
  std::optional<Peak> peak_above(double least, Order order) const;
  // Returns the largest absolute value between two places, as distances from the start of the phase.
  double highest(Order order, double from, double to) const;
  double value(double way, Order order) const;

  double way() const { return way_; }
  double time_at(double way) const;  // since the start of the phase

 private:
  // The places within the phase at which the value may have a peak between its ends.
  struct Places {
    double first = 0;
    double second = 0;
  };
  Places places_of_peaks(Order order) const;
  double square_at(double way) const;  // ṡ²

  Derivatives slopes_;
  double velocity_;
  double acceleration_;
  double duration_;
  double way_;
  // q̈ = even + rise σ + bend σ²
  double even_;
  double rise_;
  double bend_;
};

}  // namespace passo::proof
