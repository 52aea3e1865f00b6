// StepChords: chords in whole steps. Here the coarse level of interpolation meets the fine one.
//
// Each end point is rounded by itself: from its place on the curve to the nearest step of each axis, halves away from
// zero. A chord is the difference of two such places. So each end is within half a step of the curve, and all chords of
// a job add up to its rounded end. A chord shorter than a step is left out; the next chord includes its way.
// `distances` is what a line interpolator takes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "passo/geometry/chords.hpp"

namespace passo {

inline constexpr std::size_t space_axes = 3;

// Steps a millimetre of X, Y and Z, each above 0.
struct StepScale {
  std::array<double, space_axes> steps_per_mm = {1, 1, 1};
};

using StepPlace = std::array<Steps, space_axes>;

// Fails beyond 2^52 steps from zero: a double no longer tells halves there.
Result<StepPlace, CurveError> to_steps(const Vector3& place, const StepScale& scale);

struct StepChord {
  Chord chord;  // the piece of the curve that it stands for, from the end of the last one; includes chords left out
  std::int32_t distances[space_axes] = {};  // NOLINT: an array as interpolators take it; ±(2^31 - 1) at most
  StepPlace end = {};
};

class StepChords final : public Source<StepChord> {
 public:
  // `chords` begins at `start` and must outlive the StepChords.
  StepChords(Source<Chord>& chords, const Vector3& start, const StepScale& scale);

  // Returns false at the end, and where something is out of range; error() tells which.
  [[nodiscard]] bool next(StepChord& chord) override;
  const std::optional<CurveError>& error() const { return error_; }
  // Where the last chord ended.
  const StepPlace& place() const { return place_; }

 private:
  bool fail(const CurveError& error);

  Source<Chord>& chords_;
  StepScale scale_;
  StepPlace place_ = {};
  std::optional<CurveError> error_;
};

}  // namespace passo
