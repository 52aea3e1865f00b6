// CurveDerivatives: the first three derivatives of a curve by s at one point, equal to Curve::tangent(),
// second_derivative() and third_derivative(), except for the last bits of the third. On an arc all three share one sine
// and cosine, which are the largest part of the cost.
#pragma once

#include "passo/geometry/curve.hpp"

namespace passo {

struct CurveDerivatives {
  Point first;
  Point second;
  Point third;
};

// `s` must be on the curve.
CurveDerivatives derivatives_at(const Curve& curve, Mm s);

}  // namespace passo
