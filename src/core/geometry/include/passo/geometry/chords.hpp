// Chords: cuts a curve into straight pieces that stay within a tolerance. This is the coarse level of interpolation.
// Any fine line interpolator can then follow the chords (StepChords).
//
// A pull stage: one chord per call, constant memory, no heap. Every chord begins where the last one ended, and the last
// chord ends exactly at the curve's end. No chord crosses a point where the curve's formula changes. The curve's own
// deviation() bounds every chord by the tolerance.
//
// There are as few chords as the tolerance allows. Circles and helices get the smallest number of equal chords. On
// other curves each chord is as long as possible, to within two or three per cent, and the last two chords of a piece
// have equal parameter ranges.
//
// Source: the sagitta as in any handbook of NC (r - sqrt(r² - L²/4)). For control points: Farin, Curves and Surfaces
// for CAGD, ch. 5 and 6.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "passo/base/source.hpp"
#include "passo/geometry/parametric_curve.hpp"

namespace passo {

// The maximum distance of a chord from its curve: at least a nanometre, because smaller values approach the rounding
// error of doubles.
class ChordTolerance {
 public:
  static constexpr Mm least{1e-6};
  static Result<ChordTolerance, CurveError> of(Mm tolerance) {
    if (tolerance >= least) return ChordTolerance(tolerance);
    return Failure{CurveError{"the tolerance must be 0.000001 mm or more"}};
  }
  Mm value() const { return value_; }

 private:
  explicit ChordTolerance(Mm value) : value_(value) {}
  Mm value_;
};

struct Chord {
  double from = 0;  // the curve's parameter at the chord's start and end
  double to = 0;
  Vector3 end;   // the curve's point at `to`
  Mm deviation;  // an upper bound of the distance between curve and chord
};

// `curve` must outlive the Chords.
template <ParametricCurve C>
class Chords final : public Source<Chord> {
 public:
  Chords(const C& curve, ChordTolerance tolerance)
      : curve_(curve), tolerance_(tolerance.value()), u_(curve.range().low), piece_end_(u_) {}

  [[nodiscard]] bool next(Chord& chord) override {
    if (u_ >= piece_end_ && !begin_piece()) return false;
    chord.from = u_;
    if (curve_.is_even()) {
      next_equal(chord);
    } else {
      next_longest(chord);
    }
    u_ = chord.to;
    chord.end = curve_.at(u_);
    return true;
  }

 private:
  bool begin_piece() {
    if (u_ >= curve_.range().high) return false;
    piece_start_ = u_;
    piece_end_ = curve_.next_break(u_);
    step_ = piece_end_ - u_;
    taken_ = 0;
    if (curve_.is_even()) count_ = smallest_count();
    return true;
  }

  void next_equal(Chord& chord) {
    ++taken_;
    const double share = static_cast<double>(taken_) / static_cast<double>(count_);
    chord.to = taken_ == count_ ? piece_end_ : piece_start_ + (piece_end_ - piece_start_) * share;
    chord.deviation = curve_.deviation(chord.from, chord.to);
  }

  // Returns the smallest number of equal chords, found by doubling and then by bisection.
  std::int64_t smallest_count() const {
    const double whole = piece_end_ - piece_start_;
    const auto good = [&](std::int64_t count) {
      const double part = piece_start_ + whole / static_cast<double>(count);
      return curve_.deviation(piece_start_, part) <= tolerance_ * rounding;
    };
    std::int64_t enough = 1;
    while (!good(enough)) enough *= 2;
    std::int64_t too_few = enough / 2;
    while (enough - too_few > 1) {
      const std::int64_t middle = too_few + (enough - too_few) / 2;
      (good(middle) ? enough : too_few) = middle;
    }
    return enough;
  }

  void next_longest(Chord& chord) {
    const double rest = piece_end_ - u_;
    find_longest(rest);
    double to = good_ < rest ? u_ + good_ : piece_end_;
    if (good_ < rest && rest < 2 * good_) {
      // Halves the remaining curve only if both halves are within the tolerance. Otherwise more than two chords are
      // left, and halving would waste some.
      const double half = u_ + rest / 2;
      const Mm there = curve_.deviation(u_, half);
      if (there <= tolerance_ && curve_.deviation(half, piece_end_) <= tolerance_) {
        to = half;
        deviation_ = there;
      }
    }
    chord.to = to;
    chord.deviation = deviation_;
    step_ = good_;
  }

  // Finds the longest chord within the tolerance. The deviation is nearly proportional to the square of the chord
  // length, which gives the next guess. A bracket between the longest valid chord and the shortest invalid one handles
  // other curves (an inflection, a cusp).
  void find_longest(double rest) {
    good_ = 0;
    double bad = rest * 2;
    double guess = std::min(step_, rest);
    for (int tries = 0; bad > good_ * (1 + nearness) && (tries < enough_tries || good_ == 0); ++tries) {
      const bool whole = guess >= rest;
      const double to = whole ? piece_end_ : u_ + guess;
      if (!(to > u_)) break;
      const Mm deviation = curve_.deviation(u_, to);
      if (deviation <= tolerance_) {
        good_ = guess;
        deviation_ = deviation;
        if (whole || deviation >= tolerance_ * (1 - 2 * nearness)) return;
      } else {
        bad = guess;
      }
      guess = next_guess(guess, deviation, bad, rest);
    }
    if (good_ > 0) return;
    // `neighbour` is the next double after u_: no shorter chord exists.
    const double neighbour = std::nextafter(u_, piece_end_);
    deviation_ = curve_.deviation(u_, neighbour);
    good_ = neighbour - u_;
  }

  double next_guess(double guess, Mm deviation, double bad, double rest) const {
    if (!std::isfinite(deviation.value())) return (good_ + bad) / 2;
    const double by_square = deviation > Mm(0) ? guess * std::sqrt(tolerance_ * (1 - nearness) / deviation) : rest;
    if (bad > rest) return std::clamp(by_square, good_, rest);
    // Bisects where the square law leads out of the bracket, e.g. at the tip of an ellipse.
    const bool inside = by_square > good_ && by_square < bad;
    if (!inside) return (good_ + bad) / 2;
    return std::max(by_square, good_ > 0 ? good_ : guess / 8);  // no valid chord yet: at least an eighth of the guess
  }

  static constexpr double nearness = 0.02;
  static constexpr int enough_tries = 16;
  // A small allowance for rounding: a tolerance computed elsewhere as the sagitta of n equal chords must give n chords.
  static constexpr double rounding = 1 + 1e-12;

  const C& curve_;
  Mm tolerance_;
  double u_;
  double piece_start_ = 0;
  double piece_end_;
  double step_ = 0;  // the last longest chord; the next search starts with it
  double good_ = 0;
  Mm deviation_;
  std::int64_t count_ = 0;  // the number of equal chords in this piece, and how many of them were returned
  std::int64_t taken_ = 0;
};

}  // namespace passo
