// SplineChords: a spline of the program, in machine coordinates, cut into chords. Private to path/.
//
// Bézier curves without weights (G5, G5.1) are cut as they are; a NURBS takes memory of its own while it is cut.
// Source<Chord> that can begin again with another spline; constant work a chord.
#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "passo/geometry/bezier.hpp"
#include "passo/geometry/chords.hpp"
#include "passo/geometry/nurbs.hpp"

namespace passo {

struct SplinePoint {
  Vector3 place;
  double weight = 1;
};

class SplineChords final : public Source<Chord> {
 public:
  // The control points of the next spline; their memory is kept from one to the next.
  void clear() { points_.clear(); }
  void add(const Vector3& place, double weight) { points_.push_back({place, weight}); }
  // What is wrong with the spline, if anything; there are no chords then.
  std::optional<CurveError> begin(int degree, ChordTolerance tolerance);
  [[nodiscard]] bool next(Chord& chord) override;
  // Whether the chord that was given last ends the spline.
  bool at_end() const { return at_end_; }

 private:
  // The chords refer to the curve beside them, so neither moves.
  template <ParametricCurve C>
  struct Cut {
    Cut(const C& curve_to_cut, ChordTolerance tolerance) : curve(curve_to_cut), chords(curve, tolerance) {}
    Cut(const Cut&) = delete;
    Cut& operator=(const Cut&) = delete;
    C curve;
    Chords<C> chords;
  };
  template <class C>
  std::optional<CurveError> cut(const Result<C, CurveError>& curve, ChordTolerance tolerance);

  std::variant<std::monostate, Cut<QuadraticBezier>, Cut<CubicBezier>, Cut<Nurbs>> cut_;
  std::vector<SplinePoint> points_;
  bool at_end_ = true;
};

}  // namespace passo
