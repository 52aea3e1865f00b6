// StepChords: chords in whole steps, between the coarse and the fine level of interpolation.
//
// Each end point is rounded separately: from its point on the curve to the nearest step of each axis, halves away from
// zero. A chord is the difference of two such points. So each end is within half a step of the curve, and the sum of
// all chords of a job is its rounded end. A chord shorter than a step is omitted; the next chord includes its distance.
// `distances` is the input of a line interpolator.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "passo/geometry/chords.hpp"

namespace passo {

inline constexpr std::size_t space_axes = 3;

// Steps per millimetre of X, Y and Z, each above 0.
struct StepScale {
  std::array<double, space_axes> steps_per_mm = {1, 1, 1};
};

using StepPlace = std::array<Steps, space_axes>;

// Fails beyond 2^52 steps from zero, where a double can no longer represent halves.
Result<StepPlace, CurveError> to_steps(const Vector3& place, const StepScale& scale);

struct StepChord {
  Chord chord;  // the corresponding piece of the curve, from the end of the last chord; includes omitted chords
  std::int32_t distances[space_axes] = {};  // NOLINT: an array as interpolators take it; ±(2^31 - 1) at most
  StepPlace end = {};
};

class StepChords final : public Source<StepChord> {
 public:
  // `chords` must start at `start` and outlive the StepChords.
  StepChords(Source<Chord>& chords, const Vector3& start, const StepScale& scale);

  // Returns false at the end, and if a value is out of range; error() gives the reason.
  [[nodiscard]] bool next(StepChord& chord) override;
  const std::optional<CurveError>& error() const { return error_; }
  // Returns the end of the last chord.
  const StepPlace& place() const { return place_; }

 private:
  bool fail(const CurveError& error);

  Source<Chord>& chords_;
  StepScale scale_;
  StepPlace place_ = {};
  std::optional<CurveError> error_;
};

}  // namespace passo
