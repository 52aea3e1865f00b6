#include "fit_spline.hpp"

#include <cmath>
#include <cstddef>

namespace passo {
namespace {

using Row = std::vector<double>;

// Solves the tridiagonal system below x[i-1] + middle x[i] + above x[i+1] = right (Thomas), for X and Y together.
std::vector<FitPoint> solved(const Row& below, const Row& middle, const Row& above, std::vector<FitPoint> right) {
  const std::size_t n = middle.size();
  Row share(n, 0);
  double pivot = middle[0];
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) {
      share[i - 1] = above[i - 1] / pivot;
      pivot = middle[i] - below[i] * share[i - 1];
      right[i].x -= below[i] * right[i - 1].x;
      right[i].y -= below[i] * right[i - 1].y;
    }
    right[i].x /= pivot;
    right[i].y /= pivot;
  }
  for (std::size_t i = n - 1; i-- > 0;) {
    right[i].x -= share[i] * right[i + 1].x;
    right[i].y -= share[i] * right[i + 1].y;
  }
  return right;
}

// The derivatives of the spline at its points.
class FitSlopes {
 public:
  FitSlopes(const std::vector<FitPoint>& points, const Row& lengths) : points_(points), lengths_(lengths) {}

  std::vector<FitPoint> open(const FitPoint& start, const FitPoint& end) {
    const std::size_t n = points_.size();
    reserve(n);
    for (std::size_t i = 1; i + 1 < n; ++i) set(i, i - 1, i);
    set_end(0, 0, start);
    set_end(n - 1, n - 2, end);
    return solved(below_, middle_, above_, right_);
  }

  // Cyclic: by Sherman and Morrison.
  std::vector<FitPoint> closed() {
    const std::size_t n = points_.size();
    reserve(n);
    for (std::size_t i = 0; i < n; ++i) set(i, (i + n - 1) % n, i);
    const double corner_low = above_[n - 1];  // of the last row, for the first slope
    const double corner_high = below_[0];     // of the first row, for the last slope
    const double gamma = -middle_[0];
    middle_[0] -= gamma;
    middle_[n - 1] -= corner_low * corner_high / gamma;
    std::vector<FitPoint> slopes = solved(below_, middle_, above_, right_);
    std::vector<FitPoint> unit(n);
    unit[0].x = gamma;
    unit[n - 1].x = corner_low;
    const std::vector<FitPoint> z = solved(below_, middle_, above_, unit);
    const double share = corner_high / gamma;
    const double factor = 1 + z[0].x + share * z[n - 1].x;
    const FitPoint v{(slopes[0].x + share * slopes[n - 1].x) / factor,
                     (slopes[0].y + share * slopes[n - 1].y) / factor};
    for (std::size_t i = 0; i < n; ++i) slopes[i] = {slopes[i].x - v.x * z[i].x, slopes[i].y - v.y * z[i].x};
    return slopes;
  }

 private:
  void reserve(std::size_t n) {
    below_.assign(n, 0);
    middle_.assign(n, 1);
    above_.assign(n, 0);
    right_.assign(n, {});
  }
  FitPoint step(std::size_t piece) const {
    const FitPoint& a = points_[piece];
    const FitPoint& b = points_[(piece + 1) % points_.size()];
    return {b.x - a.x, b.y - a.y};
  }
  // Equal second derivatives of the pieces before and after a point.
  void set(std::size_t row, std::size_t before, std::size_t after) {
    const double a = 1 / lengths_[before];
    const double b = 1 / lengths_[after];
    below_[row] = a;
    middle_[row] = 2 * (a + b);
    above_[row] = b;
    const FitPoint p = step(before);
    const FitPoint q = step(after);
    right_[row] = {3 * (p.x * a * a + q.x * b * b), 3 * (p.y * a * a + q.y * b * b)};
  }
  void set_end(std::size_t row, std::size_t piece, const FitPoint& direction) {
    const double length = std::hypot(direction.x, direction.y);
    const FitPoint way = step(piece);
    if (length > 0 && std::isfinite(length)) {
      const double speed = std::hypot(way.x, way.y) / lengths_[piece];
      right_[row] = {direction.x / length * speed, direction.y / length * speed};
      return;
    }
    middle_[row] = 2;
    (row == 0 ? above_ : below_)[row] = 1;
    right_[row] = {3 * way.x / lengths_[piece], 3 * way.y / lengths_[piece]};
  }

  const std::vector<FitPoint>& points_;
  const Row& lengths_;
  Row below_;
  Row middle_;
  Row above_;
  std::vector<FitPoint> right_;
};

double distance(const FitPoint& a, const FitPoint& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

}  // namespace

std::vector<CubicPiece> cubics_through(const FitSpline& spline) {
  std::vector<FitPoint> points;
  constexpr double least = 1e-9;
  for (const FitPoint& point : spline.points) {
    if (points.empty() || distance(points.back(), point) > least) points.push_back(point);
  }
  bool is_closed = spline.is_closed;
  if (is_closed && points.size() > 1 && distance(points.front(), points.back()) <= least) points.pop_back();
  constexpr std::size_t fewest_closed = 3;
  is_closed = is_closed && points.size() >= fewest_closed;
  if (points.size() < 2) return {};
  const std::size_t count = is_closed ? points.size() : points.size() - 1;
  Row lengths(count);
  for (std::size_t i = 0; i < count; ++i) {
    lengths[i] = std::pow(distance(points[i], points[(i + 1) % points.size()]), spline.exponent);
  }
  FitSlopes equations(points, lengths);
  const std::vector<FitPoint> slopes = is_closed ? equations.closed() : equations.open(spline.start, spline.end);
  std::vector<CubicPiece> pieces;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % points.size();
    const double third = lengths[i] / 3;
    pieces.push_back({points[i],
                      {points[i].x + slopes[i].x * third, points[i].y + slopes[i].y * third},
                      {points[next].x - slopes[next].x * third, points[next].y - slopes[next].y * third},
                      points[next]});
  }
  return pieces;
}

}  // namespace passo
