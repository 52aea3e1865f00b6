// SplinePieces: divides a programmed spline, in machine coordinates, into cubics of its length (Curve::cubic). Private
// to path/.
//
// Points are chosen on the spline, and the length between them is found by Gauss-Legendre quadrature. The cubics
// through these points have tangents that make the second derivative continuous too (the interpolating spline of de
// Boor, A Practical Guide to Splines, ch. IV). Where the spline's own second derivative jumps, at a knot, a section
// ends with the spline's direction. The cubics' deviation from the spline grows with the fourth power of their length,
// so few cubics are needed. The deviation is measured: at eighths, the difference between the curves at equal lengths;
// between the eighths, d²/8 of the largest second derivative of the difference at both sides. Around a cusp the pieces
// get short. A piece shorter than `least_piece` is a straight line.
//
// Bézier curves without weights (G5, G5.1) are used unchanged. A section and a NURBS use memory while they are
// processed.
#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/geometry/bezier.hpp"
#include "passo/geometry/curve.hpp"
#include "passo/geometry/nurbs.hpp"

namespace passo {

struct SplinePoint {
  Vector3 place;
  double weight = 1;
};

// A straight piece has no tangents.
struct SplinePiece {
  double from = 0;  // the spline's parameter at both ends
  double to = 0;
  Vector3 begin;
  Vector3 end;
  Vector3 first_tangent;
  Vector3 last_tangent;
  double length = 0;
  bool straight = false;

  // Changes only X and Y; the other axes are constant.
  Curve curve_from(const Point& place) const;
};

class SplinePieces final : public Source<SplinePiece> {
 public:
  static constexpr double least_piece = 1e-4;  // mm

  // The control points of the next spline. Their memory is reused from spline to spline.
  void clear() { points_.clear(); }
  void add(const Vector3& place, double weight) { points_.push_back({place, weight}); }
  // Begins a spline. Returns the error in the spline, if any; then there are no pieces. No piece deviates from the
  // spline by more than `tolerance`.
  std::optional<CurveError> begin(int degree, Mm tolerance);
  [[nodiscard]] bool next(SplinePiece& piece) override;
  // Returns true if the last returned piece ends the spline.
  bool at_end() const { return at_end_; }

 private:
  template <class C>
  std::optional<CurveError> begin_curve(const Result<C, CurveError>& curve);
  template <class C>
  void fit_stretch(const C& curve);
  template <class C>
  SplinePiece longest_piece(const C& curve, double tolerance);

  std::variant<std::monostate, QuadraticBezier, CubicBezier, Nurbs> curve_;
  std::vector<SplinePoint> points_;
  double tolerance_ = 0;
  std::vector<SplinePiece> stretch_;
  std::size_t given_ = 0;  // pieces of the section returned so far
  double u_ = 0;           // the parameter reached so far
  double step_ = 0;        // step of the last piece, at which the next search begins
  bool at_end_ = true;
};

}  // namespace passo
