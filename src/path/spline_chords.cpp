#include "spline_chords.hpp"

#include <algorithm>
#include <type_traits>

namespace passo {
namespace {

template <std::size_t degree>
Result<Bezier<degree>, CurveError> bezier_of(std::span<const SplinePoint> points) {
  typename Bezier<degree>::Control control;
  for (std::size_t i = 0; i <= degree; ++i) control[i] = points[i].place;
  return Bezier<degree>::create(control);
}

Result<Nurbs, CurveError> nurbs_of(std::span<const SplinePoint> points, int degree) {
  Nurbs::Definition definition{.degree = degree};
  definition.control.reserve(points.size());
  definition.weights.reserve(points.size());
  for (const SplinePoint& point : points) {
    definition.control.push_back(point.place);
    definition.weights.push_back(point.weight);
  }
  return Nurbs::create(std::move(definition));
}

}  // namespace

template <class C>
std::optional<CurveError> SplineChords::cut(const Result<C, CurveError>& curve, ChordTolerance tolerance) {
  if (!curve) return curve.error();
  cut_.emplace<Cut<C>>(*curve, tolerance);
  at_end_ = false;
  return std::nullopt;
}

std::optional<CurveError> SplineChords::begin(int degree, ChordTolerance tolerance) {
  const std::span<const SplinePoint> points(points_);
  cut_.emplace<std::monostate>();
  at_end_ = true;
  const bool one_piece = points.size() == static_cast<std::size_t>(degree) + 1;
  const bool weighted = std::ranges::any_of(points, [](const SplinePoint& point) { return point.weight != 1; });
  if (one_piece && !weighted && degree == 2) return cut(bezier_of<2>(points), tolerance);
  if (one_piece && !weighted && degree == 3) return cut(bezier_of<3>(points), tolerance);
  return cut(nurbs_of(points, degree), tolerance);
}

bool SplineChords::next(Chord& chord) {
  return std::visit(
      [&](auto& cut) {
        if constexpr (std::is_same_v<decltype(cut), std::monostate&>) {
          return false;
        } else {
          if (!cut.chords.next(chord)) return false;
          at_end_ = chord.to >= cut.curve.range().high;
          return true;
        }
      },
      cut_);
}

}  // namespace passo
