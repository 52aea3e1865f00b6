// ChordFitter: one least-squares cubic, and its distance from the chords.
#include <algorithm>
#include <cmath>
#include <limits>

#include "chord_fitter.hpp"

#include "passo/base/lanes.hpp"
#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// In tolerances: the greatest distance of the chords from the cubic. The rest is the tube around the cubic.
constexpr double share_of_tolerance = 0.98;
// In tolerances: a smaller misfit is as good as none.
constexpr double no_misfit = 0.02;
// A chord's distance is measured at enough points that at most this fraction of the tolerance is missed between them.
constexpr double close_enough = 0.02;
constexpr double most_parts = 64;
// The least length of the cubic, as a fraction of its chords: stairs along a diagonal of the grid are 1.41 times as
// long.
constexpr double least_length = 0.7;
// A free end of the cubic is at its point nearest to the chords, within this part of it. Farther on, the cubic is
// inaccurate.
constexpr double cut_from = 0.6;
constexpr double cut_to = 0.8;
// The weight of an end that must be met, among weights whose sum is 1.
constexpr double pinning = 1e6;

// Legendre's polynomials of the degrees 4 and 6, and of the degrees 5 and 7, at x from -1 to 1.
struct NextPolynomials {
  TwoLanes even;
  TwoLanes odd;

  explicit NextPolynomials(double x) {
    const TwoLanes y(x * x);
    even = TwoLanes(3. / 8, -5. / 16) +
           y * (TwoLanes(-30. / 8, 105. / 16) + y * (TwoLanes(35. / 8, -315. / 16) + y * TwoLanes(0, 231. / 16)));
    odd = TwoLanes(15. / 8, -35. / 16) +
          y * (TwoLanes(-70. / 8, 315. / 16) + y * (TwoLanes(63. / 8, -693. / 16) + y * TwoLanes(0, 429. / 16)));
    odd = odd * x;
  }
};

template <std::size_t axes>
double product(const std::array<double, axes>& a, const std::array<double, axes>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < axes; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void ChordFitter::Sums::add(const Vertex& vertex, double weight, bool wide) {
  double power = vertex.s * weight;
  for (Point& moment : moments) {
    for (std::size_t i = 0; i < 3; ++i) moment.values[i] += vertex.way.values[i] * power;
    for (std::size_t i = 3; i < axis_count && wide; ++i) moment.values[i] += vertex.way.values[i] * power;
    power *= vertex.s;
  }
  power = vertex.s * vertex.s * weight;
  for (double& sum : powers) {
    sum += power;
    power *= vertex.s;
  }
}

// The three normal equations, in u = s / length, by Gauss's elimination.
ChordFitter::Fit ChordFitter::solved(bool end_is_free) const {
  const Vertex& last = vertices_.back();
  const double end_weight = end_is_free ? 0 : pinning;
  Sums sums = sums_;
  sums.add(last, last_chord_ / 2, wide_);
  std::array<double, 5> powers{};
  std::array<double, 3> scales{};
  double scale = 1 / last.s;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    scale /= last.s;
    if (i < scales.size()) scales[i] = scale;
    powers[i] = sums.powers[i] * (scale / last.s) + end_weight;
  }
  const double by_first = powers[1] / powers[0];
  const double by_first2 = powers[2] / powers[0];
  const double middle = powers[2] - by_first * powers[1];
  const double beside = powers[3] - by_first * powers[2];
  const double by_middle = beside / middle;
  const double corner = powers[4] - by_first2 * powers[2] - by_middle * beside;
  Fit fit{.count = vertices_.size(), .end_is_free = end_is_free, .parts = {}};
  for (std::size_t i = 0; i < (wide_ ? axis_count : 3); ++i) {
    const double end = last.way.values[i] * end_weight;
    const double first = sums.moments[0].values[i] * scales[0] + end;
    const double second = sums.moments[1].values[i] * scales[1] + end - by_first * first;
    const double third = sums.moments[2].values[i] * scales[2] + end - by_first2 * first - by_middle * second;
    const double cube = third / corner;
    const double square = (second - beside * cube) / middle;
    fit.parts[2].values[i] = cube;
    fit.parts[1].values[i] = square;
    fit.parts[0].values[i] = (first - powers[1] * square - powers[2] * cube) / powers[0];
  }
  return fit;
}

template <std::size_t axes>
inline std::array<double, axes> ChordFitter::Fit::miss_at(double u, const Point& way,
                                                          std::array<double, axes>& slope) const {
  std::array<double, axes> miss;
  for (std::size_t i = 0; i < axes; ++i) {
    const double first = parts[0].values[i];
    const double second = parts[1].values[i];
    const double third = parts[2].values[i];
    slope[i] = first + (2 * second + 3 * third * u) * u;
    miss[i] = way.values[i] - (first + (second + third * u) * u) * u;
  }
  const double along = product(miss, slope) / product(slope, slope);
  for (std::size_t i = 0; i < axes; ++i) miss[i] -= slope[i] * along;
  return miss;
}

// Returns the greatest distance among some points between two vertices.
template <std::size_t axes>
double ChordFitter::farthest_inside(const Fit& fit, const Vertex& before, const Vertex& vertex, double parts) const {
  double square = 0;
  for (double part = 1; part < parts; ++part) {
    const double to = part / parts;
    const Point way = before.way + (vertex.way - before.way) * to;
    std::array<double, axes> slope;
    const auto miss = fit.miss_at<axes>((before.s + (vertex.s - before.s) * to) / vertices_.back().s, way, slope);
    square = std::max(square, product(miss, miss));
  }
  return std::sqrt(square);
}

// Whether the chords follow the cubic. Sets the distance of the chords from it: at the vertices and, where that may
// matter, within the chords, plus d²/8 |p''| between two such points. A vertex may be ahead or behind along the cubic;
// the length by which a chord moves back along it counts as distance.
template <std::size_t axes>
[[gnu::flatten]] bool ChordFitter::passes_in(Fit& fit) const {
  const double whole = vertices_.back().s;
  const double per_whole = 1 / whole;
  const double bend =
      2 * std::max(length_of(fit.parts[1]), length_of(fit.parts[1] + fit.parts[2] * 3)) / (whole * whole);
  const double most = share_of_tolerance * tolerance_;
  const double until = fit.end_is_free ? cut_to * whole : whole;
  const Vertex start;
  const Vertex* before = &start;
  double off_before = ahead_.front().moved;
  double back = 0;
  std::array<TwoLanes, axes> even{};
  std::array<TwoLanes, axes> odd{};
  for (const Vertex* vertex = vertices_.data(); vertex <= &vertices_.back(); before = vertex++) {
    std::array<double, axes> slope;
    const double u = vertex->s * per_whole;
    const auto miss = fit.miss_at<axes>(u, vertex->way, slope);
    const NextPolynomials polynomials(2 * u - 1);
    const double weight = ((vertex == &vertices_.back() ? vertex : vertex + 1)->s - before->s) / 2;
    for (std::size_t i = 0; i < axes; ++i) {
      even[i] += polynomials.even * (miss[i] * weight);
      odd[i] += polynomials.odd * (miss[i] * weight);
    }
    if (before->s >= until) continue;
    const double off = std::sqrt(product(miss, miss));
    double forward = 0;
    for (std::size_t i = 0; i < axes; ++i) forward += (vertex->way.values[i] - before->way.values[i]) * slope[i];
    if (back > 0 || forward < 0) back = std::max(0.0, back - forward / std::sqrt(product(slope, slope)));
    const double chord = vertex->s - before->s;
    double between = chord * chord * bend / 8;
    double deviation = std::max(off, off_before) + back;
    off_before = off;
    if (deviation + between + vertex->deviation > most / 2) {
      const double parts = std::min(most_parts, std::ceil(std::sqrt(between / (close_enough * tolerance_))));
      deviation = std::max(deviation, farthest_inside<axes>(fit, *before, *vertex, parts) + back);
      between /= std::max(1.0, parts * parts);
    }
    deviation += between + vertex->deviation;
    if (deviation > most) return false;
    fit.deviation = std::max(fit.deviation, deviation);
  }
  TwoLanes even_square;
  TwoLanes odd_square;
  for (std::size_t i = 0; i < axes; ++i) {
    even_square += even[i] * even[i];
    odd_square += odd[i] * odd[i];
  }
  const double square = (even_square * TwoLanes(9, 13) + odd_square * TwoLanes(11, 15)).sum();  // times 2 k + 1
  fit.error = std::max(std::sqrt(square) * per_whole, no_misfit * tolerance_) / std::sqrt(whole);
  fit.window = whole;

  // The cubic's parameter is its length where it is fastest, so that |dP/ds| is at most 1 and the feed need not be
  // reduced anywhere.
  const SurfaceScale& surface = segment_at(ahead_.first())->surface;
  const CountedGroup group = counted_group(vertices_.back().way, surface);
  double longest = 0;
  for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    longest = std::max(longest, square_in(fit.slope_at(u), group, surface));
  }
  fit.length = std::sqrt(longest);
  return fit.length >= least_length * whole;
}

// Ends the cubic at the point nearest to the chords.
template <std::size_t axes>
void ChordFitter::cut_in(Fit& fit) const {
  constexpr double least_rest = 1e-3;  // of a chord: a shorter rest is no chord
  const double from = cut_from * fit.window;
  const double to = cut_to * fit.window;
  double nearest = std::numeric_limits<double>::max();
  double end = 1;
  Point way;  // to the chord's point there
  Vertex before;
  for (std::size_t i = 0; before.s < to; before = vertices_[i++]) {
    const Vertex& vertex = vertices_[i];
    if (vertex.s <= from) continue;
    std::array<double, axes> slope;
    const auto miss = fit.miss_at<axes>(before.s / fit.window, before.way, slope);
    auto change = fit.miss_at<axes>(vertex.s / fit.window, vertex.way, slope);
    for (std::size_t k = 0; k < axes; ++k) change[k] -= miss[k];
    const double chord = vertex.s - before.s;
    const double first = std::max(least_rest, (from - before.s) / chord);
    const double last = std::min(1.0, (to - before.s) / chord);
    const double square = product(change, change);
    double share = square > 0 ? std::max(first, std::min(last, -product(miss, change) / square)) : last;
    if (share > 1 - least_rest) share = 1;
    const double off = product(miss, miss) + share * (2 * product(miss, change) + share * square);
    if (off >= nearest) continue;
    way = before.way + (vertex.way - before.way) * share;
    end = (before.s + chord * share) / fit.window;
    nearest = off;
    fit.count = share < 1 ? i : i + 1;
    fit.share = share < 1 ? share : 0;
  }
  for (int k = 0; k < 2; ++k) {
    const Point along = fit.slope_at(end);
    end += dot(way - fit.way_at(end), along) / dot(along, along);
  }
  fit.moved = distance(fit.way_at(end), way);
  double power = 1;
  for (Point& part : fit.parts) part = part * (power *= end);
  fit.length *= end;
}

bool ChordFitter::passes(Fit& fit) const {
  return wide_ ? passes_in<axis_count>(fit) : passes_in<3>(fit);
}

void ChordFitter::cut(Fit& fit) const {
  wide_ ? cut_in<axis_count>(fit) : cut_in<3>(fit);
}

}  // namespace passo
