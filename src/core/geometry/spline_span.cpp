#include "spline_span.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace passo {
namespace {

using Pyramid = std::array<WeightedPoint, most_spline_degree + 1>;

WeightedPoint between(const WeightedPoint& a, const WeightedPoint& b, double share) {
  const double rest = 1 - share;
  return {rest * a.x + share * b.x, rest * a.y + share * b.y, rest * a.z + share * b.z,
          rest * a.weight + share * b.weight};
}

WeightedPoint difference(const WeightedPoint& a, const WeightedPoint& b, double factor) {
  return {(a.x - b.x) * factor, (a.y - b.y) * factor, (a.z - b.z) * factor, (a.weight - b.weight) * factor};
}

// The blossom f with `first` arguments u, then `second` arguments v, then w for all others.
WeightedPoint blossom(const SplineSpan& span, double u, int first, double v = 0, int second = 0, double w = 0) {
  Pyramid row;
  std::copy_n(span.points, span.degree + 1, row.begin());
  for (int level = 1; level <= span.degree; ++level) {
    const double argument = level <= first ? u : level <= first + second ? v : w;
    for (int i = span.degree; i >= level; --i) {
      const auto at = static_cast<std::size_t>(i);
      const double left = span.knots[i - 1];
      const double right = span.knots[i + span.degree - level];
      row[at] = between(row[at - 1], row[at], (argument - left) / (right - left));
    }
  }
  return row[static_cast<std::size_t>(span.degree)];
}

WeightedPoint weighted_derivative(const SplineSpan& span, double u) {
  const int rest = span.degree - 1;
  const double factor = span.degree / (span.high() - span.low());
  return difference(blossom(span, u, rest, span.high(), 1), blossom(span, u, rest, span.low(), 1), factor);
}

WeightedPoint weighted_second_derivative(const SplineSpan& span, double u) {
  if (span.degree < 2) return {0, 0, 0, 0};
  const int rest = span.degree - 2;
  const double length = span.high() - span.low();
  const double factor = span.degree * (span.degree - 1) / (length * length);
  const WeightedPoint high = blossom(span, u, rest, span.high(), 2);
  const WeightedPoint mixed = blossom(span, u, rest, span.low(), 1, span.high());
  const WeightedPoint low = blossom(span, u, rest, span.low(), 2);
  return difference(difference(high, mixed, 1), difference(mixed, low, 1), factor);
}

class StraightPiece {
 public:
  StraightPiece(const Vector3& from, const Vector3& to) : from_(from), way_(to - from), square_(dot(way_, way_)) {}

  double distance(const Vector3& place) const {
    const Vector3 arm = place - from_;
    if (!(square_ > 0)) return std::sqrt(dot(arm, arm));
    const double share = std::clamp(dot(arm, way_) / square_, 0.0, 1.0);
    const Vector3 off = arm - way_ * share;
    return std::sqrt(dot(off, off));
  }

 private:
  Vector3 from_;
  Vector3 way_;
  double square_;
};

// A curve lies in the convex hull of its control points, and the distance from a straight piece is a convex function.
// So no point of the curve is farther than the farthest control point. Halving the curve brings the control points
// close to it; the search halves on only where the result may still change.
class HullSearch {
 public:
  HullSearch(const StraightPiece& chord, int degree) : chord_(chord), degree_(degree) {}

  double bound(const Pyramid& control, int depth) {
    double farthest = 0;
    for (int i = 0; i <= degree_; ++i) {
      farthest = std::max(farthest, chord_.distance(control[static_cast<std::size_t>(i)].place()));
    }
    if (depth == 0 || farthest <= reached_ * near_enough) return farthest;
    Pyramid left;
    Pyramid right = control;
    halve(left, right);
    reached_ = std::max(reached_, chord_.distance(right[0].place()));
    return std::max(bound(left, depth - 1), bound(right, depth - 1));
  }

 private:
  static constexpr double near_enough = 1.02;

  // de Casteljau's algorithm. Before the call `right` is the whole curve.
  void halve(Pyramid& left, Pyramid& right) const {
    left[0] = right[0];
    for (int level = 1; level <= degree_; ++level) {
      for (int i = 0; i <= degree_ - level; ++i) {
        const auto at = static_cast<std::size_t>(i);
        right[at] = between(right[at], right[at + 1], 0.5);
      }
      left[static_cast<std::size_t>(level)] = right[0];
    }
  }

  const StraightPiece& chord_;
  int degree_;
  double reached_ = 0;  // the largest distance of the curve itself seen so far
};

}  // namespace

double distance_from_chord(std::span<const WeightedPoint> control) {
  constexpr int deepest = 6;
  Pyramid points;
  std::copy(control.begin(), control.end(), points.begin());
  const StraightPiece chord(control.front().place(), control.back().place());
  return HullSearch(chord, static_cast<int>(control.size()) - 1).bound(points, deepest);
}

Vector3 SplineSpan::at(double u) const {
  return blossom(*this, u, degree).place();
}

// Derivatives of P = A / w: P' = (A' - w' P) / w, P'' = (A'' - 2 w' P' - w'' P) / w.
Vector3 SplineSpan::derivative(double u) const {
  const WeightedPoint value = blossom(*this, u, degree);
  const WeightedPoint first = weighted_derivative(*this, u);
  return (first.weighted() - value.place() * first.weight) / value.weight;
}

Vector3 SplineSpan::second_derivative(double u) const {
  const WeightedPoint value = blossom(*this, u, degree);
  const WeightedPoint first = weighted_derivative(*this, u);
  const WeightedPoint second = weighted_second_derivative(*this, u);
  const Vector3 slope = (first.weighted() - value.place() * first.weight) / value.weight;
  return (second.weighted() - slope * (2 * first.weight) - value.place() * second.weight) / value.weight;
}

Mm SplineSpan::deviation(double from, double to) const {
  Pyramid control;
  for (int i = 0; i <= degree; ++i) control[static_cast<std::size_t>(i)] = blossom(*this, from, degree - i, to, i);
  return Mm(distance_from_chord({control.data(), static_cast<std::size_t>(degree) + 1}));
}

}  // namespace passo
