// EqualChords: cuts a curve into chords of equal length L. This is the coarse level of interpolation by period: a
// control that computes one chord in each period T makes chords of L = F·T at the feed F. The deviation then follows
// from the curve, on a radius r about L²/(8r); Chords does the reverse and derives the length from a tolerance.
//
// A pull stage like Chords: one chord per call, constant memory, no heap. Every chord begins where the last one ended.
// Each end is the next point of the curve at the distance L, found to the rounding of doubles. The last chord may be
// shorter. A chord may cross points where the curve's formula changes.
//
// The search advances in eighths of a chord, so it misses loops smaller than that. `deviation` is the distance of each
// chord from its curve; infinite if the chord is too long for the curve.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "passo/geometry/chords.hpp"

namespace passo {

// The length of a chord: above 0.
class ChordLength {
 public:
  static Result<ChordLength, CurveError> of(Mm length) {
    if (length >= ChordTolerance::least && std::isfinite(length.value())) return ChordLength(length);
    return Failure{CurveError{"a chord must be 0.000001 mm long or more"}};
  }
  Mm value() const { return value_; }

 private:
  explicit ChordLength(Mm value) : value_(value) {}
  Mm value_;
};

// `curve` must outlive the EqualChords.
template <ParametricCurve C>
class EqualChords final : public Source<Chord> {
 public:
  EqualChords(const C& curve, ChordLength length)
      : curve_(curve), length_(length.value().value()), u_(curve.range().low) {}

  [[nodiscard]] bool next(Chord& chord) override {
    if (u_ >= curve_.range().high) return false;
    chord.from = u_;
    chord.to = end_of_chord();
    chord.end = curve_.at(chord.to);
    chord.deviation = deviation(chord);
    u_ = chord.to;
    return true;
  }

 private:
  double end_of_chord() const {
    const Vector3 start = curve_.at(u_);
    const auto away = [&](double u) { return passo::length(curve_.at(u) - start); };
    double inside = u_;
    while (true) {
      const double u = step_from(inside);
      if (away(u) >= length_) return where(inside, u, away);
      if (u >= curve_.range().high) return u;
      inside = u;
    }
  }

  // Returns the parameter about an eighth of a chord ahead, within the same piece, because the next piece may have a
  // different speed. Where the curve's speed is nearly zero (a cusp) this estimate is too large, so a step is at most a
  // 64th of the curve.
  double step_from(double u) const {
    const ParameterRange range = curve_.range();
    const double speed = passo::length(curve_.derivative(u));
    double step = (range.high - range.low) / 64;
    if (speed > 0) step = std::min(step, length_ / (8 * speed));
    return std::min(std::max(u + step, std::nextafter(u, range.high)), curve_.next_break(u));
  }

  template <class Away>
  double where(double inside, double outside, const Away& away) const {
    while (true) {
      const double middle = inside + (outside - inside) / 2;
      if (middle <= inside || middle >= outside) return outside;
      (away(middle) < length_ ? inside : outside) = middle;
    }
  }

  // Between two breaks the curve is within its own deviation of the chord of that section, and no point of this chord
  // is farther from the whole chord than its ends.
  Mm deviation(const Chord& chord) const {
    const Vector3 start = curve_.at(chord.from);
    Mm most{0};
    double away = 0;
    for (double u = chord.from; u < chord.to;) {
      const double to = std::min(curve_.next_break(u), chord.to);
      const double before = std::exchange(away, to < chord.to ? distance(start, chord.end, curve_.at(to)) : 0);
      most = std::max(most, curve_.deviation(u, to) + Mm(std::max(before, away)));
      u = to;
    }
    return most;
  }
  static double distance(const Vector3& a, const Vector3& b, const Vector3& place) {
    return passo::length(place - nearest_of(a, b, place));
  }

  const C& curve_;
  double length_;
  double u_;
};

}  // namespace passo
