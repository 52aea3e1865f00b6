#include "passo/geometry/step_chords.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace passo {
namespace {

constexpr double most_steps = 4503599627370496.0;  // 2^52
constexpr std::int64_t longest = std::numeric_limits<std::int32_t>::max();

}  // namespace

Result<StepPlace, CurveError> to_steps(const Vector3& place, const StepScale& scale) {
  const std::array<double, space_axes> mm = {place.x, place.y, place.z};
  StepPlace steps;
  for (std::size_t i = 0; i < space_axes; ++i) {
    if (!(scale.steps_per_mm[i] > 0)) {
      return Failure{CurveError{std::string("the scale of ") + "XYZ"[i] + " must be above 0 steps/mm"}};
    }
    const double exact = mm[i] * scale.steps_per_mm[i];
    if (!(std::abs(exact) <= most_steps)) {
      return Failure{CurveError{std::string("a position on ") + "XYZ"[i] + " is more than 2^52 steps from zero"}};
    }
    steps[i] = Steps{std::llround(exact)};  // halves away from zero
  }
  return steps;
}

StepChords::StepChords(Source<Chord>& chords, const Vector3& start, const StepScale& scale)
    : chords_(chords), scale_(scale) {
  const Result<StepPlace, CurveError> place = to_steps(start, scale);
  if (place) {
    place_ = *place;
  } else {
    error_ = place.error();
  }
}

bool StepChords::fail(const CurveError& error) {
  error_ = error;
  return false;
}

bool StepChords::next(StepChord& chord) {
  for (std::optional<double> from; !error_ && chords_.next(chord.chord);) {
    chord.chord.from = from.value_or(chord.chord.from);
    from = chord.chord.from;
    const Result<StepPlace, CurveError> end = to_steps(chord.chord.end, scale_);
    if (!end) return fail(end.error());
    bool moves = false;
    for (std::size_t i = 0; i < space_axes; ++i) {
      const std::int64_t distance = (*end)[i].count - place_[i].count;
      if (distance > longest || distance < -longest) {
        return fail({std::string("a chord is longer than 2147483647 steps on ") + "XYZ"[i]});
      }
      chord.distances[i] = static_cast<std::int32_t>(distance);
      moves = moves || distance != 0;
    }
    if (!moves) continue;
    place_ = chord.end = *end;
    return true;
  }
  return false;
}

}  // namespace passo
