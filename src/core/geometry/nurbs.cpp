#include "passo/geometry/nurbs.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "spline_span.hpp"

namespace passo {
namespace {

static_assert(Nurbs::most_degree == most_spline_degree);

using Checked = Status<CurveError>;

Failure<CurveError> wrong(std::string message) {
  return Failure{CurveError{std::move(message)}};
}

Checked check_points(const Nurbs::Definition& spline) {
  const std::size_t count = spline.control.size();
  if (spline.degree < 1 || spline.degree > Nurbs::most_degree) {
    return wrong("the degree of a NURBS must be 1 to " + std::to_string(Nurbs::most_degree) + ", not " +
                 std::to_string(spline.degree));
  }
  const auto least = static_cast<std::size_t>(spline.degree) + 1;
  if (count < least) {
    return wrong("a NURBS of degree " + std::to_string(spline.degree) + " needs at least " + std::to_string(least) +
                 " control points, not " + std::to_string(count));
  }
  if (!std::ranges::all_of(spline.control, is_in_bounds)) {
    return wrong("control points must be within 100000 mm of the origin");
  }
  if (spline.weights.empty()) return Unit{};
  if (spline.weights.size() != count) {
    return wrong("a NURBS needs a weight for each control point: " + std::to_string(count) + ", not " +
                 std::to_string(spline.weights.size()));
  }
  const auto good = [](double weight) { return weight > 0 && std::isfinite(weight); };
  if (!std::ranges::all_of(spline.weights, good)) return wrong("the weights of a NURBS must be above 0");
  const auto [smallest, largest] = std::ranges::minmax(spline.weights);
  if (largest / smallest > Nurbs::most_weight_ratio) {
    return wrong("the largest weight of a NURBS must be at most 10000 times the smallest");
  }
  return Unit{};
}

Checked check_knots(int degree, const std::vector<double>& knots, std::size_t control_points) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t needed = control_points + p + 1;
  if (knots.size() != needed) {
    return wrong("a NURBS of degree " + std::to_string(degree) + " with " + std::to_string(control_points) +
                 " control points needs " + std::to_string(needed) + " knots, not " + std::to_string(knots.size()));
  }
  if (!std::ranges::all_of(knots, [](double knot) { return std::isfinite(knot); })) {
    return wrong("the knots of a NURBS must be numbers");
  }
  if (!std::ranges::is_sorted(knots)) return wrong("the knots of a NURBS must not decrease");
  const double whole = knots[control_points] - knots[p];
  if (!(whole > 0) || !std::isfinite(whole)) return wrong("with these knots, the NURBS has no length");
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double step = knots[i + 1] - knots[i];
    if (step > 0 && !(step >= 1e-9 * whole)) return wrong("two knots of a NURBS are almost equal; make them equal");
  }
  // p + 1 equal knots inside would tear the curve apart.
  for (std::size_t i = 1; i + p < knots.size() - 1; ++i) {
    if (knots[i] == knots[i + p] && knots[i] > knots[p] && knots[i] < knots[control_points]) {
      return wrong("a NURBS of degree " + std::to_string(degree) + " can repeat an inner knot at most " +
                   std::to_string(degree) + " times");
    }
  }
  return Unit{};
}

}  // namespace

std::vector<double> Nurbs::clamped_knots(int degree, std::size_t control_points) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> knots(control_points + p + 1);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    knots[i] = static_cast<double>(std::clamp(i, p, control_points) - p);
  }
  return knots;
}

Result<Nurbs, CurveError> Nurbs::create(Definition definition) {
  const Checked points = check_points(definition);
  if (!points) return Failure{points.error()};
  std::vector<double> knots = std::move(definition.knots);
  if (knots.empty()) knots = clamped_knots(definition.degree, definition.control.size());
  const Checked checked = check_knots(definition.degree, knots, definition.control.size());
  if (!checked) return Failure{checked.error()};
  return Nurbs(definition, std::move(knots));
}

Nurbs::Nurbs(const Definition& definition, std::vector<double> knots)
    : degree_(definition.degree), knots_(std::move(knots)) {
  const std::vector<Vector3>& control = definition.control;
  const auto p = static_cast<std::size_t>(degree_);
  for (std::size_t i = 0; i < control.size(); ++i) {
    points_.push_back(WeightedPoint::of(control[i], definition.weights.empty() ? 1 : definition.weights[i]));
  }
  range_ = {knots_[p], knots_[control.size()]};
  // A clamped end is the control point itself. Multiplying it by its weight and dividing again might change it.
  const bool clamped_start = knots_[1] == range_.low && knots_[p + 1] > range_.low;
  const bool clamped_end = knots_[knots_.size() - 2] == range_.high && knots_[control.size() - 1] < range_.high;
  start_ = clamped_start ? control.front() : span_of(range_.low).at(range_.low);
  end_ = clamped_end ? control.back() : span_of(range_.high).at(range_.high);
}

SplineSpan Nurbs::span_of(double u) const {
  const auto p = static_cast<std::ptrdiff_t>(degree_);
  // The last knot that is not above u and that begins a span.
  const auto inside = knots_.end() - p - 1;
  auto next = std::upper_bound(knots_.begin() + p + 1, inside, u);
  if (next == inside) next = std::lower_bound(knots_.begin() + p + 1, inside, range_.high);
  const std::ptrdiff_t first = next - knots_.begin() - 1 - p;
  return {.degree = degree_, .points = points_.data() + first, .knots = knots_.data() + first + 1};
}

Vector3 Nurbs::at(double u) const {
  if (u == range_.low) return start_;
  if (u == range_.high) return end_;
  return span_of(u).at(u);
}
Vector3 Nurbs::derivative(double u) const {
  return span_of(u).derivative(u);
}
Vector3 Nurbs::second_derivative(double u) const {
  return span_of(u).second_derivative(u);
}
double Nurbs::next_break(double u) const {
  return span_of(u).high();
}
Mm Nurbs::deviation(double from, double to) const {
  return span_of(from).deviation(from, to);
}

}  // namespace passo
