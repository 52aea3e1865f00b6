#include "airfoil_spline.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

// The second derivatives of the natural spline at the parameters.
std::vector<double> curvatures(const std::vector<double>& at, const std::vector<double>& values) {
  const std::size_t last = at.size() - 1;
  std::vector<double> second(at.size(), 0);
  std::vector<double> upper(at.size(), 0);
  // A tridiagonal system: forward elimination, then back substitution.
  for (std::size_t i = 1; i < last; ++i) {
    const double before = at[i] - at[i - 1];
    const double after = at[i + 1] - at[i];
    const double right = 6 * ((values[i + 1] - values[i]) / after - (values[i] - values[i - 1]) / before);
    const double pivot = 2 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    second[i] = (right - before * second[i - 1]) / pivot;
  }
  for (std::size_t i = last; i-- > 1;) second[i] -= upper[i] * second[i + 1];
  return second;
}

}  // namespace

std::vector<AirfoilPoint> airfoil_spline(const std::vector<AirfoilPoint>& points, double tolerance) {
  std::vector<double> at = {0};
  std::vector<double> xs = {points.front().x};
  std::vector<double> ys = {points.front().y};
  for (std::size_t i = 1; i < points.size(); ++i) {
    at.push_back(at.back() + std::sqrt(std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y)));
    xs.push_back(points[i].x);
    ys.push_back(points[i].y);
  }
  const std::vector<double> of_x = curvatures(at, xs);
  const std::vector<double> of_y = curvatures(at, ys);
  std::vector<AirfoilPoint> curve = {points.front()};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double h = at[i + 1] - at[i];
    // A chord deviates by at most an eighth of the second derivative times the square of the parameter interval.
    const double bend = std::max(std::hypot(of_x[i], of_y[i]), std::hypot(of_x[i + 1], of_y[i + 1])) * h * h / 8;
    constexpr double most = 64;
    const double parts = std::clamp(std::ceil(std::sqrt(bend / tolerance)), 1.0, most);
    for (double k = 1; k <= parts; ++k) {
      const double b = k / parts;
      const double a = 1 - b;
      const double wa = (a * a * a - a) * h * h / 6;
      const double wb = (b * b * b - b) * h * h / 6;
      curve.push_back({a * xs[i] + b * xs[i + 1] + wa * of_x[i] + wb * of_x[i + 1],
                       a * ys[i] + b * ys[i + 1] + wa * of_y[i] + wb * of_y[i + 1]});
    }
    curve.back() = points[i + 1];
  }
  return curve;
}

}  // namespace passo
