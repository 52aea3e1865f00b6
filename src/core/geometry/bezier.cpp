#include "passo/geometry/bezier.hpp"

#include <algorithm>

#include "spline_span.hpp"

namespace passo {
namespace {

// A Bézier curve is a spline of one span whose knots all lie at its ends.
template <std::size_t degree>
class AsSpan {
 public:
  explicit AsSpan(const std::array<Vector3, degree + 1>& control) {
    for (std::size_t i = 0; i <= degree; ++i) points_[i] = WeightedPoint::of(control[i], 1);
    std::fill(knots_.begin() + degree, knots_.end(), 1.0);
  }
  SplineSpan span() const {
    return {.degree = static_cast<int>(degree), .points = points_.data(), .knots = knots_.data()};
  }

 private:
  std::array<WeightedPoint, degree + 1> points_;
  std::array<double, 2 * degree> knots_{};
};

}  // namespace

template <std::size_t degree>
Result<Bezier<degree>, CurveError> Bezier<degree>::create(const Control& control) {
  if (!std::ranges::all_of(control, is_in_bounds)) {
    return Failure{CurveError{"control points must be within 100000 mm of the origin"}};
  }
  return Bezier(control);
}

template <std::size_t degree>
Vector3 Bezier<degree>::at(double u) const {
  return AsSpan<degree>(control_).span().at(u);
}
template <std::size_t degree>
Vector3 Bezier<degree>::derivative(double u) const {
  return AsSpan<degree>(control_).span().derivative(u);
}
template <std::size_t degree>
Vector3 Bezier<degree>::second_derivative(double u) const {
  return AsSpan<degree>(control_).span().second_derivative(u);
}
template <std::size_t degree>
Mm Bezier<degree>::deviation(double from, double to) const {
  return AsSpan<degree>(control_).span().deviation(from, to);
}

template class Bezier<2>;
template class Bezier<3>;

Result<QuadraticBezier, CurveError> parabola(const Vector3& vertex, const Vector3& focus, Mm from, Mm to) {
  if (!is_in_bounds(vertex) || !is_in_bounds(focus)) {
    return Failure{CurveError{"vertex and focus of a parabola must be within 100000 mm of the origin"}};
  }
  if (vertex.z != focus.z) return Failure{CurveError{"vertex and focus of a parabola must have the same Z"}};
  const double focal_length = length(focus - vertex);
  if (!(focal_length > 0)) return Failure{CurveError{"vertex and focus of a parabola must be two different points"}};
  const Vector3 axis = (focus - vertex) / focal_length;
  const Vector3 right = {axis.y, -axis.x, 0};
  const double a = from.value();
  const double b = to.value();
  // The tangents at the ends a and b meet at (a + b) / 2 across the axis, and at a b / (4 f) along it.
  const auto place = [&](double across, double product) {
    return vertex + right * across + axis * (product / (4 * focal_length));
  };
  return QuadraticBezier::create({place(a, a * a), place((a + b) / 2, a * b), place(b, b * b)});
}

}  // namespace passo
