// CurveDerivatives: the first three derivatives of a curve by s at one place, as Curve::tangent(), second_derivative()
// and third_derivative() give them, but for the last bits of the third. On an arc all three share one sine and cosine,
// which cost more than the rest.
#pragma once

#include "passo/geometry/curve.hpp"

namespace passo {

struct CurveDerivatives {
  Point first;
  Point second;
  Point third;
};

// `s` lies on the curve.
CurveDerivatives derivatives_at(const Curve& curve, Mm s);

}  // namespace passo
