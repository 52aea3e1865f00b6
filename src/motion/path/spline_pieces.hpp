// SplinePieces: cuts a spline of the program, in machine coordinates, into cubics in its length (Curve::cubic). Private
// to path/.
//
// Places are chosen on the spline, and the length between them is found by Gauss-Legendre quadrature. The cubics
// through these places have tangents that make the second derivative continuous too (the interpolating spline of de
// Boor, A Practical Guide to Splines, ch. IV). Where the spline's own second derivative jumps, at a knot, a stretch
// ends with the spline's direction. The cubics' deviation from the spline grows with the fourth power of their length,
// so few cubics are needed. The deviation is measured: the difference at eighths, where both curves have gone the same
// way, and between them d²/8 of the largest second derivative of the difference at both sides. Around a cusp the pieces
// get short. A piece shorter than `least_piece` is a straight line.
//
// Bézier curves without weights (G5, G5.1) are taken unchanged. A stretch and a NURBS take memory while they last.
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

  // Only X and Y; the other axes stay.
  Curve curve_from(const Point& place) const;
};

class SplinePieces final : public Source<SplinePiece> {
 public:
  static constexpr double least_piece = 1e-4;  // mm

  // The control points of the next spline. Their memory is kept from one spline to the next.
  void clear() { points_.clear(); }
  void add(const Vector3& place, double weight) { points_.push_back({place, weight}); }
  // Begins a spline. Returns what is wrong with the spline, if anything; then there are no pieces. No piece leaves the
  // spline by more than `tolerance`.
  std::optional<CurveError> begin(int degree, Mm tolerance);
  [[nodiscard]] bool next(SplinePiece& piece) override;
  // True: the piece that was given last ends the spline.
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
  std::size_t given_ = 0;  // pieces of the stretch given so far
  double u_ = 0;           // the parameter reached so far
  double step_ = 0;        // of the last piece: where the next search begins
  bool at_end_ = true;
};

}  // namespace passo
