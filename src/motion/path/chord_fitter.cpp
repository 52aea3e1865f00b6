#include "chord_fitter.hpp"

#include <algorithm>
#include <cmath>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// Of the tolerance: how far the chords may be from the cubic. Rounding to a grid of half the tolerance leaves up to
// 0.36 of it (half a diagonal of the grid), and the cubic's own error comes on top. The rest is the tube around the
// cubic.
constexpr double share_of_tolerance = 0.5;
// Of the tolerance: the misfit that neighbouring residuals have in common. Found by trial: less stops at rounding where
// it goes on in the same way for long (near slopes like 3/4), more lets cubics go on where the curve does not follow.
constexpr double common_share = 0.03;
// The cosine of the sharpest turn from chord to chord: a right angle, as in the stairs of a grid.
constexpr double sharpest = -1e-3;
// The cubic is at least this share of its chords: stairs along a diagonal of the grid are 1.41 times as long as it.
constexpr double least_length = 0.7;

// In tolerances: so far from a corner nothing is fitted. There the motion is slow, and the corner needs all of the
// tube.
constexpr double clearance = 15;
constexpr double far = 1e9;

// The number of chords tried next, after this number was fitted.
constexpr std::uint64_t more_than(std::uint64_t count) {
  return count + count / 2;
}

// The weight of an end that must be met, among weights whose sum is 1.
constexpr double pinning = 1e6;

Point unit(const Point& way) {
  return way * (1 / length_of(way));
}

}  // namespace

bool ChordFitter::has(std::uint64_t number) {
  while (number >= ahead_.end() && !at_end_) {
    Ahead& next = ahead_.append();
    next.moved = 0;
    at_end_ = !merger_.next(next.item, next.deviation);
    if (at_end_) ahead_.drop_back();
  }
  return number < ahead_.end();
}

bool ChordFitter::may_begin(const Segment& segment) const {
  return segment.curve.shape() == Curve::Shape::line && segment.mode == PathMode::continuous &&
         segment.lock == SpindleLock::none && mode_before_ != PathMode::exact_path;
}

// Whether the next line may be a chord of the same curve. Where a vertex is off by h, it is seen as a turn of up to h
// (1/a + 1/b) between chords of the lengths a and b, and twice that where its neighbours are off to the other side.
bool ChordFitter::goes_on_after(std::uint64_t number) {
  if (!has(number + 1)) return false;
  const Segment* const line = segment_at(number);
  const Segment* const next = segment_at(number + 1);
  if (next == nullptr || next->curve.shape() != Curve::Shape::line || !are_alike(*line, *next)) return false;
  const Point in = line->curve.end() - line->curve.start();
  const Point out = next->curve.end() - next->curve.start();
  const double before = length_of(in);
  const double after = length_of(out);
  const SurfaceScale& surface = line->surface;
  if (dot(in, out) < sharpest * before * after || counted_group(in, surface) != counted_group(out, surface)) {
    return false;
  }
  const double turn = distance(in * (1 / before), out * (1 / after));
  return turn * before * after <= 2 * share_of_tolerance * tolerance_ * (before + after);
}

void ChordFitter::add_chord(std::uint64_t number) {
  const Curve& chord = segment_at(number)->curve;
  const Point& start = segment_at(ahead_.first())->curve.start();
  const auto add = [&](const Vertex& vertex, double weight) {
    double power = vertex.s * weight;
    for (std::size_t i = 0; i < sums_.moments.size(); ++i) {
      sums_.moments[i] = sums_.moments[i] + vertex.way * power;
      power *= vertex.s;
    }
    power = vertex.s * vertex.s * weight;
    for (double& sum : sums_.powers) {
      sum += power;
      power *= vertex.s;
    }
  };
  const double length = chord.length().value();
  // The trapezoidal rule over s: half the chord's length belongs to each of its ends.
  if (!vertices_.empty()) add(vertices_.back(), length / 2);
  const double s = vertices_.empty() ? length : vertices_.back().s + length;
  vertices_.push_back({.s = s, .way = chord.end() - start, .deviation = ahead_[number].deviation});
  add(vertices_.back(), length / 2);
}

ChordFitter::Fit ChordFitter::longest_fit() {
  const std::uint64_t first = ahead_.first();
  add_chords(1);
  Fit longest;
  for (std::uint64_t goal = least_fitted; goal <= most_fitted; goal = more_than(goal)) {
    bool goes_on = goes_on_after(first + vertices_.size() - 1);
    while (goes_on && vertices_.size() < goal) {
      add_chord(first + vertices_.size());
      goes_on = goes_on_after(first + vertices_.size() - 1);
    }
    const bool is_all = !goes_on;
    if (!goes_on && comes_to_a_corner()) {
      stay_clear_of_the_end();
      goes_on = true;
    }
    if (vertices_.size() < least_fitted || vertices_.size() <= longest.count) break;
    const Fit longer = fit(goes_on);
    if (longer.count == 0) break;
    if (!longer.misses) longest = longer;
    if (is_all) break;
  }
  return longest;
}

bool ChordFitter::comes_to_a_corner() {
  const std::uint64_t last = ahead_.first() + vertices_.size() - 1;
  return segment_at(last)->mode != PathMode::exact_stop && has(last + 1) && segment_at(last + 1) != nullptr;
}

void ChordFitter::stay_clear_of_the_end() {
  const double end = vertices_.back().s - clearance * tolerance_;
  std::size_t count = vertices_.size();
  while (count > 0 && vertices_[count - 1].s > end) --count;
  add_chords(count);
}

void ChordFitter::add_chords(std::size_t count) {
  vertices_.clear();
  sums_ = {};
  for (std::size_t i = 0; i < count; ++i) add_chord(ahead_.first() + i);
}

// A free end moves the start of the next chord. If that is too much for the chord or for its tube, the cubic ends at
// the vertex.
ChordFitter::Fit ChordFitter::fit(bool end_is_free) const {
  constexpr double share = 0.25;
  if (end_is_free) {
    Fit free = solved(true);
    const Segment& next = *segment_at(ahead_.first() + vertices_.size());
    const double moved = distance(free.way_at(1), vertices_.back().way);
    if (moved <= share * std::min(next.curve.length().value(), tolerance_)) return passes(free) ? free : Fit{};
  }
  Fit pinned = solved(false);
  return passes(pinned) ? pinned : Fit{};
}

// The three normal equations, in u = s / length, by Gauss's elimination.
ChordFitter::Fit ChordFitter::solved(bool end_is_free) const {
  const double length = vertices_.back().s;
  const double end_weight = end_is_free ? 0 : pinning;
  std::array<double, 5> powers{};
  Fit fit{.count = vertices_.size(), .parts = {}, .end_is_free = end_is_free};
  double scale = 1 / length;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    scale /= length;
    if (i < 3) fit.parts[i] = sums_.moments[i] * scale + vertices_.back().way * end_weight;
    powers[i] = sums_.powers[i] * (scale / length) + end_weight;
  }
  std::array<std::array<double, 3>, 3> rows{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) rows[i][k] = powers[i + k];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t below = i + 1; below < 3; ++below) {
      const double times = rows[below][i] / rows[i][i];
      for (std::size_t k = i; k < 3; ++k) rows[below][k] -= times * rows[i][k];
      fit.parts[below] = fit.parts[below] - fit.parts[i] * times;
    }
  }
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t k = i + 1; k < 3; ++k) fit.parts[i] = fit.parts[i] - fit.parts[k] * rows[i][k];
    fit.parts[i] = fit.parts[i] * (1 / rows[i][i]);
  }
  return fit;
}

// Whether the chords follow the cubic. Sets how far the chords are from it: at the vertices and in the chords' middles,
// and between two such places d²/8 |p''| more. A vertex may be ahead or behind along the cubic, as long as every chord
// goes forward.
bool ChordFitter::passes(Fit& fit) const {
  const double whole = vertices_.back().s;
  const double bend =
      2 * std::max(length_of(fit.parts[1]), length_of(fit.parts[1] + fit.parts[2] * 3)) / (whole * whole);
  const auto miss_at = [&](double u, const Point& way, Point& direction) {
    direction = unit(fit.slope_at(u));
    const Point residual = way - fit.way_at(u);
    return residual - direction * dot(residual, direction);
  };
  const double most = share_of_tolerance * tolerance_;
  Vertex before;
  Point miss_before;
  double off_before = ahead_.front().moved;
  double common = 0;
  for (const Vertex& vertex : vertices_) {
    Point direction;
    const Point miss = miss_at(vertex.s / whole, vertex.way, direction);
    if (!(dot(vertex.way - before.way, direction) > 0)) return false;
    const double off = length_of(miss);
    const double chord = vertex.s - before.s;
    double between = chord * chord * bend / 8;
    double deviation = std::max(off, off_before);
    if (deviation + between + vertex.deviation > most / 2) {
      const Point middle = miss_at((vertex.s + before.s) / (2 * whole), (vertex.way + before.way) * 0.5, direction);
      deviation = std::max(deviation, length_of(middle));
      between /= 4;
    }
    deviation += between + vertex.deviation;
    if (deviation > most) return false;
    fit.deviation = std::max(fit.deviation, deviation);
    common += chord * dot(miss, miss_before);
    before = vertex;
    off_before = off;
    miss_before = miss;
  }
  const double most_common = common_share * tolerance_;
  fit.misses = common > most_common * most_common * whole;

  // The cubic's parameter counts its length where it is fastest, so that |dP/ds| is at most 1
  // and the feed need not be reduced anywhere.
  const SurfaceScale& surface = segment_at(ahead_.first())->surface;
  const CountedGroup group = counted_group(vertices_.back().way, surface);
  fit.length = 0;
  for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    fit.length = std::max(fit.length, length_in(fit.slope_at(u), group, surface));
  }
  return fit.length >= least_length * whole;
}

void ChordFitter::emit_cubic(const Fit& fit, PathItem& item, double& deviation) {
  const std::uint64_t first = ahead_.first();
  const std::uint64_t next = first + fit.count;
  const Point start = segment_at(first)->curve.start();
  Point end = segment_at(next - 1)->curve.end();
  const Point free_end = start + fit.way_at(1);
  const double share = 1 / fit.length;
  const PathMode mode = segment_at(next - 1)->mode;
  std::swap(item, ahead_[first].item);
  auto& segment = std::get<Segment>(item);
  segment.mode = mode;
  if (fit.end_is_free) {
    auto& after = std::get<Segment>(ahead_[next].item);
    ahead_[next].moved = distance(free_end, end);
    after.curve = Curve::line(free_end, after.curve.end(), after.surface);
    end = free_end;
  }
  segment.curve = Curve::cubic(start, fit.slope_at(0) * share, end, fit.slope_at(1) * share, Mm(fit.length));
  deviation = fit.deviation;
  ahead_.drop_before(next);
}

bool ChordFitter::next(PathItem& item, double& deviation) {
  if (!has(ahead_.first())) return false;
  const auto* const ahead = segment_at(ahead_.first());
  bool goes_on = false;
  if (ahead != nullptr && may_begin(*ahead)) {
    tolerance_ = ahead->tolerance.value();
    // After a wider tolerance the line stays apart, as in LineMerger.
    const bool stays_apart = mode_before_ == PathMode::continuous && tolerance_before_ > tolerance_;
    if (mode_before_ == PathMode::continuous) tolerance_ = std::min(tolerance_, tolerance_before_);
    goes_on = !stays_apart && goes_on_after(ahead_.first());
  }
  const Fit fit = goes_on && since_corner_ >= clearance * tolerance_ ? longest_fit() : Fit{};
  if (fit.count > 0) {
    emit_cubic(fit, item, deviation);
    since_corner_ = far;
  } else {
    std::swap(item, ahead_.front().item);
    deviation = ahead_.front().deviation + ahead_.front().moved;
    ahead_.drop_front();
  }
  const auto* const segment = std::get_if<Segment>(&item);
  mode_before_ = segment != nullptr ? segment->mode : PathMode::exact_stop;
  tolerance_before_ = segment != nullptr ? segment->tolerance.value() : 0;
  if (mode_before_ == PathMode::exact_stop) {
    since_corner_ = far;
  } else if (fit.count == 0) {
    since_corner_ = goes_on ? since_corner_ + segment->curve.length().value() : 0;
  }
  return true;
}

}  // namespace passo
