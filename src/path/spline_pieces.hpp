// SplinePieces: a spline of the program, in machine coordinates, as cubics of its length (Curve::cubic). Private to
// path/.
//
// Places are chosen on the spline, and the length between them is found by Gauss-Legendre quadrature. The cubics
// through them have tangents such that the second derivative goes on from one to the next as well (the interpolating
// spline of de Boor, A Practical Guide to Splines, ch. IV); where the spline's own jumps, at a knot, a stretch ends
// with the spline's direction. What the cubics leave the spline by goes with the fourth power of their length, so few
// are needed. It is measured: the difference at eighths, where both have gone the same way, and between them d²/8 of
// the largest second derivative of the difference at both sides. Around a cusp pieces get short; one shorter than
// `least_piece` is a straight line.
//
// Bézier curves without weights (G5, G5.1) are taken as they are. A stretch, and a NURBS, take memory while they last.
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

  // Of X and Y; the other axes stay.
  Curve curve_from(const Point& place) const;
};

class SplinePieces final : public Source<SplinePiece> {
 public:
  static constexpr double least_piece = 1e-4;  // mm

  // The control points of the next spline; their memory is kept from one to the next.
  void clear() { points_.clear(); }
  void add(const Vector3& place, double weight) { points_.push_back({place, weight}); }
  // What is wrong with the spline, if anything; there are no pieces then. No piece leaves it by more than `tolerance`.
  std::optional<CurveError> begin(int degree, Mm tolerance);
  [[nodiscard]] bool next(SplinePiece& piece) override;
  // Whether the piece that was given last ends the spline.
  bool at_end() const { return at_end_; }

 private:
  template <class C>
  std::optional<CurveError> take(const Result<C, CurveError>& curve);
  template <class C>
  void take_stretch(const C& curve);
  template <class C>
  SplinePiece take_longest(const C& curve, double tolerance);

  std::variant<std::monostate, QuadraticBezier, CubicBezier, Nurbs> curve_;
  std::vector<SplinePoint> points_;
  double tolerance_ = 0;
  std::vector<SplinePiece> stretch_;
  std::size_t given_ = 0;  // of its pieces
  double u_ = 0;           // the parameter that is reached
  double step_ = 0;        // the last piece's: where the next search begins
  bool at_end_ = true;
};

}  // namespace passo
