#include "spline_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace passo {
namespace {

constexpr std::size_t parts = 8;
// The places and weights of Gauss-Legendre quadrature with three points, from -1 to 1.
constexpr std::array<double, 3> gauss_places = {-0.77459666924148338, 0, 0.77459666924148338};
constexpr std::array<double, 3> gauss_weights = {5.0 / 9, 8.0 / 9, 5.0 / 9};

// Where |dP/du| is below this share of its mean, the parameter stands still: the derivative has no direction.
constexpr double standstill = 1e-6;
// The most pieces of a stretch. The next stretch goes on with the same direction.
constexpr std::size_t most_pieces = 1024;
// How far |dP/ds| of a piece may be from 1. The feed is wrong by as much.
constexpr double feed_tolerance = 0.005;

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

template <class C>
double length_between(const C& curve, double from, double to) {
  const double middle = (from + to) / 2;
  const double half = (to - from) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < gauss_places.size(); ++i) {
    sum += gauss_weights[i] * length(curve.derivative(middle + half * gauss_places[i]));
  }
  return sum * half;
}

// d²P/ds² of a curve.
template <class C>
Vector3 bend_at(const C& curve, double u) {
  const Vector3 slope = curve.derivative(u);
  const Vector3 second = curve.second_derivative(u);
  const double square = dot(slope, slope);
  return (second - slope * (dot(second, slope) / square)) / square;
}

// The unit tangent at u. Where the parameter stands still, it comes from a place a little way towards `to`.
template <class C>
Vector3 direction_at(const C& curve, double u, double to, double still) {
  const Vector3 slope = curve.derivative(u);
  if (length(slope) > still) return slope / length(slope);
  constexpr double little = 1e-4;
  const Vector3 way = (curve.at(u + (to - u) * little) - curve.at(u)) * (to > u ? 1 : -1);
  return length(way) > 0 ? way / length(way) : Vector3{};
}

// P = start + first s + second s² + third s³, as Curve::cubic has it.
struct Cubic {
  explicit Cubic(const SplinePiece& piece) : start(piece.begin), first(piece.first_tangent) {
    const Vector3 mean = (piece.end - piece.begin) / piece.length;
    second = (mean * 3 - first * 2 - piece.last_tangent) / piece.length;
    third = (first + piece.last_tangent - mean * 2) / (piece.length * piece.length);
  }
  Vector3 at(double s) const { return start + (first + (second + third * s) * s) * s; }
  double speed(double s) const { return length(first + (second * 2 + third * (3 * s)) * s); }
  Vector3 bend(double s) const { return second * 2 + third * (6 * s); }

  Vector3 start;
  Vector3 first;
  Vector3 second;
  Vector3 third;
};

// A part of a curve: its length, and how far a cubic is from it.
template <class C>
class CurvePart {
 public:
  CurvePart(const C& curve, double from, double to) : curve_(curve), from_(from), to_(to) {
    for (std::size_t i = 0; i < parts; ++i) along_[i + 1] = along_[i] + length_between(curve, at(i), at(i + 1));
    still_ = standstill * length() / (to - from);
  }
  double length() const { return along_.back(); }

  // The cubic that has the curve's directions at both ends.
  SplinePiece piece() const {
    return {.from = from_,
            .to = to_,
            .begin = curve_.at(from_),
            .end = curve_.at(to_),
            .first_tangent = direction_at(curve_, from_, to_, still_),
            .last_tangent = direction_at(curve_, to_, from_, still_),
            .length = length()};
  }

  // An upper bound of the deviation. Infinite: the feed would be wrong.
  double deviation_of(const SplinePiece& piece) const {
    if (!(length() > 0)) return 0;
    const Cubic cubic(piece);
    double off = 0;
    double bend = 0;
    double longest = 0;
    for (std::size_t i = 0; i <= parts; ++i) {
      const double s = along_[i];
      if (std::abs(cubic.speed(s) - 1) > feed_tolerance) return std::numeric_limits<double>::infinity();
      off = std::max(off, passo::length(cubic.at(s) - curve_.at(at(i))));
      bend = std::max(bend, passo::length(cubic.bend(s) - bend_at(at(i), cubic.bend(s))));
      if (i > 0) longest = std::max(longest, s - along_[i - 1]);
    }
    return off + longest * longest / 8 * bend;
  }

 private:
  double at(std::size_t i) const { return i == parts ? to_ : from_ + (to_ - from_) * static_cast<double>(i) / parts; }
  // d²P/ds² at u, or `otherwise` where the parameter stands still.
  Vector3 bend_at(double u, const Vector3& otherwise) const {
    const Vector3 slope = curve_.derivative(u);
    return dot(slope, slope) > still_ * still_ ? passo::bend_at(curve_, u) : otherwise;
  }

  const C& curve_;
  double from_;
  double to_;
  double still_ = 0;
  std::array<double, parts + 1> along_ = {};
};

// Whether the curve's second derivative jumps at a knot.
template <class C>
bool jumps_at(const C& curve, double u, double step) {
  constexpr double little = 1e-6;   // of a step
  constexpr double nothing = 1e-3;  // of the bend
  const Vector3 before = bend_at(curve, u - little * step);
  const Vector3 after = bend_at(curve, u);
  return !(length(after - before) <= nothing * std::max(length(before), length(after)));
}

// Sets the tangents between the pieces so that the second derivative is continuous. The first and the last tangent
// stay. The equations are solved by elimination.
void join(std::vector<SplinePiece>& pieces) {
  const std::size_t count = pieces.size();
  std::vector<double> share(count, 0);
  std::vector<Vector3> tangent(count + 1);
  tangent[0] = pieces.front().first_tangent;
  tangent[count] = pieces.back().last_tangent;
  const auto pull = [&](const SplinePiece& piece) {
    return (piece.end - piece.begin) * (3 / (piece.length * piece.length));
  };
  for (std::size_t i = 1; i < count; ++i) {
    const double before = 1 / pieces[i - 1].length;
    const double after = 1 / pieces[i].length;
    const double diagonal = 2 * (before + after) - before * share[i - 1];
    share[i] = after / diagonal;
    tangent[i] = (pull(pieces[i - 1]) + pull(pieces[i]) - tangent[i - 1] * before) / diagonal;
  }
  for (std::size_t i = count - 1; i > 0; --i) tangent[i] = tangent[i] - tangent[i + 1] * share[i];
  for (std::size_t i = 0; i < count; ++i) {
    pieces[i].first_tangent = tangent[i];
    pieces[i].last_tangent = tangent[i + 1];
  }
}

template <class C>
bool all_within(const C& curve, const std::vector<SplinePiece>& pieces, double tolerance) {
  return std::ranges::all_of(pieces, [&](const SplinePiece& piece) {
    return CurvePart<C>(curve, piece.from, piece.to).deviation_of(piece) <= tolerance;
  });
}

}  // namespace

Curve SplinePiece::curve_from(const Point& place) const {
  const auto in_plane = [](Point point, const Vector3& vector) {
    point[Axis::x] = vector.x;
    point[Axis::y] = vector.y;
    return point;
  };
  const Point last = in_plane(place, end);
  if (straight || !(length > 0)) return Curve::line(place, last);
  return Curve::cubic(place, in_plane({}, first_tangent), last, in_plane({}, last_tangent), Mm(length));
}

template <class C>
std::optional<CurveError> SplinePieces::begin_curve(const Result<C, CurveError>& curve) {
  if (!curve) return curve.error();
  curve_ = *curve;
  u_ = curve->range().low;
  step_ = curve->range().high - u_;
  stretch_.clear();
  given_ = 0;
  at_end_ = false;
  return std::nullopt;
}

std::optional<CurveError> SplinePieces::begin(int degree, Mm tolerance) {
  const std::span<const SplinePoint> points(points_);
  tolerance_ = tolerance.value();
  curve_ = std::monostate();
  at_end_ = true;
  const bool one_piece = points.size() == static_cast<std::size_t>(degree) + 1;
  const bool weighted = std::ranges::any_of(points, [](const SplinePoint& point) { return point.weight != 1; });
  if (one_piece && !weighted && degree == 2) return begin_curve(bezier_of<2>(points));
  if (one_piece && !weighted && degree == 3) return begin_curve(bezier_of<3>(points));
  return begin_curve(nurbs_of(points, degree));
}

// The deviation grows with the fourth power of the length. The next guess follows from that.
template <class C>
SplinePiece SplinePieces::longest_piece(const C& curve, double tolerance) {
  constexpr double nearly = 0.95;
  constexpr double worth_trying = 1.2;  // times what was found
  const double end = curve.next_break(u_);
  const double rest = end - u_;
  SplinePiece found;
  double taken = 0;
  for (double guess = std::min(step_, rest);;) {
    if (guess > rest / 2 && guess < rest) guess = rest / 2;  // leaves no short piece for the end
    if (!(guess > worth_trying * taken)) break;
    const double to = guess < rest ? u_ + guess : end;
    const CurvePart<C> part(curve, u_, to);
    const SplinePiece piece = part.piece();
    const double deviation = part.deviation_of(piece);
    const bool good = deviation <= tolerance;
    const bool least = !good && (part.length() < least_piece || !(u_ + guess / 2 > u_));
    if (good || least) {
      found = piece;
      found.straight = least || !(part.length() > 0);
      taken = to - u_;
    }
    if (good ? to >= end : taken > 0) break;
    const double ratio = nearly * std::pow(tolerance / std::max(deviation, 1e-3 * tolerance), 0.25);
    guess = good ? std::min(rest, guess * ratio) : guess * std::clamp(ratio, 0.1, 0.9);
  }
  step_ = taken;
  u_ = taken < rest ? u_ + taken : end;
  return found;
}

// Joined cubics leave the spline by up to five times what each would alone. So the pieces are first chosen for a fifth
// of the tolerance, then for less. If that does not suffice, the pieces are not joined.
template <class C>
void SplinePieces::fit_stretch(const C& curve) {
  const double start = u_;
  const double step = step_;
  for (double share : {0.2, 0.04, 1.0}) {
    u_ = start;
    step_ = step;
    stretch_.clear();
    do {
      const double before = u_;
      stretch_.push_back(longest_piece(curve, share * tolerance_));
      if (u_ < curve.range().high && u_ >= curve.next_break(before) && jumps_at(curve, u_, u_ - before)) break;
    } while (u_ < curve.range().high && !stretch_.back().straight && stretch_.size() < most_pieces);
    const bool cut_off = stretch_.back().straight && stretch_.size() > 1;
    if (cut_off) {
      u_ = stretch_.back().from;
      stretch_.pop_back();
    }
    if (share == 1.0 || stretch_.front().straight) return;  // not joined
    join(stretch_);
    if (all_within(curve, stretch_, tolerance_)) return;
  }
}

bool SplinePieces::next(SplinePiece& piece) {
  if (at_end_) return false;
  return std::visit(
      [&](const auto& curve) {
        if constexpr (std::is_same_v<decltype(curve), const std::monostate&>) {
          return false;
        } else {
          if (given_ == stretch_.size()) {
            given_ = 0;
            fit_stretch(curve);
          }
          piece = stretch_[given_++];
          at_end_ = given_ == stretch_.size() && u_ >= curve.range().high;
          return true;
        }
      },
      curve_);
}

}  // namespace passo
