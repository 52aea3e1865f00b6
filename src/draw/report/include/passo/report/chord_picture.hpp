// A picture of a curve and its chords: a top view, a front view if the curve leaves the plane, and the deviation of the
// chords from the curve along its length.
//
// The deviation is too small to be visible, so the views magnify it by a factor that the picture states. The tolerance
// tube around the curve is magnified by the same factor.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "passo/geometry/chords.hpp"
#include "passo/geometry/equal_chords.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

struct ChordDrawing {
  static constexpr std::size_t most_chords = 20'000;

  struct Sample {
    Vector3 curve;
    Vector3 chord;  // the nearest point of the chord
  };
  Mm tolerance;                         // for equal chords: the maximum bound of all of them
  std::optional<Mm> chord_length = {};  // for equal chords; empty: determined by the tolerance
  std::vector<Vector3> ends = {};       // the end points of the chords, including the start
  std::vector<Sample> samples = {};
};

// Records the chords of the curve, at most the first `most_chords`.
template <ParametricCurve C>
ChordDrawing record_chords(const C& curve, Source<Chord>& chords) {
  ChordDrawing drawing{.tolerance = ChordTolerance::least};
  drawing.ends.push_back(curve.at(curve.range().low));
  std::vector<Chord> all;
  for (Chord chord; all.size() < ChordDrawing::most_chords && chords.next(chord);) all.push_back(chord);
  for (const Chord& chord : all) drawing.tolerance = std::max(drawing.tolerance, chord.deviation);
  const std::size_t parts = std::clamp<std::size_t>(40'000 / std::max<std::size_t>(all.size(), 1), 4, 48);
  for (const Chord& chord : all) {
    const Vector3 start = drawing.ends.back();
    for (std::size_t i = 0; i <= parts; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(parts);
      const Vector3 place = i == parts ? chord.end : curve.at(chord.from + (chord.to - chord.from) * share);
      drawing.samples.push_back({place, nearest_of(start, chord.end, place)});
    }
    drawing.ends.push_back(chord.end);
  }
  return drawing;
}

template <ParametricCurve C>
ChordDrawing record_chords(const C& curve, ChordTolerance tolerance) {
  Chords chords(curve, tolerance);
  ChordDrawing drawing = record_chords(curve, chords);
  drawing.tolerance = tolerance.value();
  return drawing;
}
template <ParametricCurve C>
ChordDrawing record_chords(const C& curve, ChordLength length) {
  EqualChords chords(curve, length);
  ChordDrawing drawing = record_chords(curve, chords);
  drawing.chord_length = length.value();
  return drawing;
}

// Draws into `file`; the caller commits it. `options.program` is the title.
Status<OutputError> draw_chords(const ChordDrawing& drawing, const PictureOptions& options, OutputFile& file);

}  // namespace passo
