// Random curves of every kind, each with an oracle. The oracle is the same curve from the textbook's formula in long
// double, and shares no code with the code under test: Bernstein's and Cox's sums instead of de Boor's pyramid, polar
// forms instead of Curve's.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "passo/geometry/bezier.hpp"
#include "passo/geometry/curve_in_space.hpp"
#include "passo/geometry/ellipse.hpp"
#include "passo/geometry/nurbs.hpp"

namespace passo::test {

using Real = long double;

struct Place {
  Real x = 0;
  Real y = 0;
  Real z = 0;
};

inline Place minus(const Place& a, const Place& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Real inner(const Place& a, const Place& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Place exact(const Vector3& v) {
  return {v.x, v.y, v.z};
}
inline Real apart(const Place& a, const Place& b) {
  const Place d = minus(a, b);
  return std::sqrt(inner(d, d));
}
// Returns the distance from the line segment from a to b.
inline Real distance(const Place& p, const Place& a, const Place& b) {
  const Place way = minus(b, a);
  const Real square = inner(way, way);
  const Real share = square > 0 ? inner(minus(p, a), way) / square : 0;
  if (share <= 0) return apart(p, a);
  if (share >= 1) return apart(p, b);
  return apart(p, {a.x + share * way.x, a.y + share * way.y, a.z + share * way.z});
}

using Oracle = std::function<Place(Real)>;

inline Real bernstein(int n, int i, Real u) {
  Real binomial = 1;
  for (int k = 1; k <= i; ++k) binomial = binomial * (n - i + k) / k;
  return binomial * std::pow(u, Real(i)) * std::pow(1 - u, Real(n - i));
}

// Returns the basis function by Cox's recursion. The last span includes its right end.
inline Real basis(const std::vector<double>& knots, std::size_t i, int degree, Real u, Real last) {
  if (degree == 0) {
    const bool inside = u >= knots[i] && (u < knots[i + 1] || (u == last && knots[i + 1] == last));
    return inside && knots[i] < knots[i + 1] ? 1 : 0;
  }
  const auto p = static_cast<std::size_t>(degree);
  const Real left = Real(knots[i + p]) - knots[i];
  const Real right = Real(knots[i + p + 1]) - knots[i + 1];
  Real sum = 0;
  if (left > 0) sum += (u - knots[i]) / left * basis(knots, i, degree - 1, u, last);
  if (right > 0) sum += (knots[i + p + 1] - u) / right * basis(knots, i + 1, degree - 1, u, last);
  return sum;
}

template <std::size_t degree>
Oracle bezier_oracle(const std::array<Vector3, degree + 1>& control) {
  return [control](Real u) {
    Place sum;
    for (std::size_t i = 0; i <= degree; ++i) {
      const Real b = bernstein(static_cast<int>(degree), static_cast<int>(i), u);
      sum = {sum.x + b * control[i].x, sum.y + b * control[i].y, sum.z + b * control[i].z};
    }
    return sum;
  };
}

inline Oracle nurbs_oracle(const Nurbs::Definition& spline) {
  return [spline](Real u) {
    const Real last = spline.knots[spline.control.size()];
    Place sum;
    Real weights = 0;
    for (std::size_t i = 0; i < spline.control.size(); ++i) {
      const Real b = basis(spline.knots, i, spline.degree, u, last) * (spline.weights.empty() ? 1 : spline.weights[i]);
      const Vector3& c = spline.control[i];
      sum = {sum.x + b * c.x, sum.y + b * c.y, sum.z + b * c.z};
      weights += b;
    }
    return Place{sum.x / weights, sum.y / weights, sum.z / weights};
  };
}

struct DrawnCurve {
  std::string kind;
  std::variant<CurveInSpace, Ellipse, QuadraticBezier, CubicBezier, Nurbs> curve;
  Oracle oracle;
};

class CurveDrawer {
 public:
  explicit CurveDrawer(std::uint64_t seed) : random_(seed) {}

  static constexpr int kinds = 7;
  DrawnCurve draw(int kind) {
    switch (kind % kinds) {
      case 0: return arc(false);
      case 1: return arc(true);
      case 2: return ellipse();
      case 3: return drawn_parabola();
      case 4: return quadratic();
      case 5: return cubic();
      default: return nurbs();
    }
  }

  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  Vector3 place(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }

  DrawnCurve arc(bool helix) {
    static constexpr std::array<std::array<Axis, 2>, 3> planes = {
        {{Axis::x, Axis::y}, {Axis::z, Axis::x}, {Axis::y, Axis::z}}};
    const auto plane = planes[static_cast<std::size_t>(whole(0, 2))];
    const Real r = std::exp(between(-2, 5));
    const Real angle = between(-3, 3);
    const Real sweep = (whole(0, 1) == 0 ? 1 : -1) * (helix ? between(0.1, 80) : between(0.01, 6.28));
    const double c1 = between(-100, 100);
    const double c2 = between(-100, 100);
    // CAM programs round their numbers, so the ends lie on slightly different circles.
    const Real grown = r * (1 + (whole(0, 1) == 0 ? 0 : 0.001 * between(-1, 1)));
    Point start;
    Point end;
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) start[axis] = end[axis] = between(-50, 50);
    if (helix) end[Axis::x] += between(-60, 60), end[Axis::y] += between(-60, 60), end[Axis::z] += between(-60, 60);
    start[plane[0]] = static_cast<double>(c1 + r * std::cos(angle));
    start[plane[1]] = static_cast<double>(c2 + r * std::sin(angle));
    end[plane[0]] = static_cast<double>(c1 + grown * std::cos(angle + sweep));
    end[plane[1]] = static_cast<double>(c2 + grown * std::sin(angle + sweep));
    const Curve curve = Curve::arc(start, end, plane[0], plane[1], c1, c2, static_cast<double>(sweep));
    const Real length = curve.length().value();
    const Oracle oracle = [=](Real s) {
      const Real share = s / length;
      std::array<Real, 3> at = {};
      for (std::size_t i = 0; i < 3; ++i) at[i] = start.values[i] + share * (Real(end.values[i]) - start.values[i]);
      at[index_of(plane[0])] = c1 + (r + share * (grown - r)) * std::cos(angle + share * sweep);
      at[index_of(plane[1])] = c2 + (r + share * (grown - r)) * std::sin(angle + share * sweep);
      return Place{at[0], at[1], at[2]};
    };
    return {helix ? "helix" : "arc", *CurveInSpace::of(curve), oracle};
  }

  DrawnCurve ellipse() {
    const Vector3 centre = place(100);
    const double a = std::exp(between(-1, 5));
    const double b = a * std::exp(between(-5, 0));
    const double turned = between(-3, 3);
    const double start = between(-7, 7);
    const double sweep = whole(0, 3) == 0 ? 2 * std::numbers::pi * whole(1, 3) : between(-12, 12);
    const Oracle oracle = [=](Real u) {
      const Real t = start + u * sweep;
      const Real along = a * std::cos(t);
      const Real beside = b * std::sin(t);
      const Real c = std::cos(Real(turned));
      const Real s = std::sin(Real(turned));
      return Place{centre.x + along * c - beside * s, centre.y + along * s + beside * c, centre.z};
    };
    return {"ellipse", *Ellipse::flat(centre, Mm(a), Mm(b), {turned}, {start}, {sweep}), oracle};
  }

  // y = x² / 4f in the parabola's own coordinate system.
  DrawnCurve drawn_parabola() {
    const Vector3 vertex = place(100);
    const double turned = between(-3, 3);
    const double f = std::exp(between(-2, 3));
    const Vector3 focus = {vertex.x - f * std::sin(turned), vertex.y + f * std::cos(turned), vertex.z};
    const double from = between(-80, 80);
    const double to = between(-80, 80);
    const Oracle oracle = [=](Real u) {
      const Real axis_x = (Real(focus.x) - vertex.x) / std::hypot(Real(focus.x) - vertex.x, Real(focus.y) - vertex.y);
      const Real axis_y = (Real(focus.y) - vertex.y) / std::hypot(Real(focus.x) - vertex.x, Real(focus.y) - vertex.y);
      const Real across = from + u * (Real(to) - from);
      const Real up = across * across / (4 * std::hypot(Real(focus.x) - vertex.x, Real(focus.y) - vertex.y));
      return Place{vertex.x + across * axis_y + up * axis_x, vertex.y - across * axis_x + up * axis_y, vertex.z};
    };
    return {"parabola", *parabola(vertex, focus, Mm(from), Mm(to)), oracle};
  }

  DrawnCurve quadratic() {
    const double size = std::exp(between(-1, 5));
    const std::array<Vector3, 3> control = {place(size), place(size), place(size)};
    return {"quadratic", *QuadraticBezier::create(control), bezier_oracle<2>(control)};
  }

  DrawnCurve cubic() {
    const double size = std::exp(between(-1, 5));
    std::array<Vector3, 4> control = {place(size), place(size), place(size), place(size)};
    if (whole(0, 2) == 0) {  // planar, where inflections and loops occur
      for (Vector3& point : control) point.z = 0;
    }
    return {"cubic", *CubicBezier::create(control), bezier_oracle<3>(control)};
  }

  Nurbs::Definition spline() {
    Nurbs::Definition spline;
    spline.degree = whole(1, 5);
    const int count = spline.degree + 1 + whole(0, 6);
    const double size = std::exp(between(0, 5));
    for (int i = 0; i < count; ++i) spline.control.push_back(place(size));
    if (whole(0, 1) == 0) {
      for (int i = 0; i < count; ++i) spline.weights.push_back(std::exp(between(-2, 2)));
    }
    spline.knots = Nurbs::clamped_knots(spline.degree, spline.control.size());
    if (whole(0, 1) == 0) {
      const auto p = static_cast<std::size_t>(spline.degree);
      const auto n = static_cast<std::size_t>(count);
      // Non-uniform knots, with double knots, and unclamped ends.
      double knot = between(-5, 5);
      const bool clamped = whole(0, 1) == 0;
      for (std::size_t i = 0; i < spline.knots.size(); ++i) {
        const bool end = i == 0 || i <= p || i > n;
        const bool repeat =
            end ? clamped && i > 0
                : i > p + 1 && i < n && p > 1 && whole(0, 3) == 0 && spline.knots[i - 1] != spline.knots[i - 2];
        if (!repeat) knot += between(0.1, 2);
        spline.knots[i] = knot;
      }
    }
    return spline;
  }

  DrawnCurve nurbs() {
    const Nurbs::Definition definition = spline();
    return {"nurbs", *Nurbs::create(definition), nurbs_oracle(definition)};
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace passo::test
