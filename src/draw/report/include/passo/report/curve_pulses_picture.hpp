// A picture of both interpolation levels on one curve: the curve, the chords of the coarse level, the pulses of the
// fine level on the step grid, and below them the deviation of each pulse from the curve.
//
// A curve that leaves the plane is drawn in two views, X Y and X Z.
#pragma once

#include <string>
#include <vector>

#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"
#include "passo/study/curve_pulses.hpp"

namespace passo {

struct CurvePulsesScene {
  static constexpr std::int64_t most_pulses = 100'000;

  std::string method;
  StepScale scale;
  std::vector<Vector3> curve = {};     // closely spaced points of the curve in mm
  std::vector<StepPlace> chords = {};  // end points of the chords, including the start
  std::vector<CurvePulse> pulses = {};
  CurveMeasures measures = {};
};

// `options.program` is the title, `options.machine` describes how the chords were chosen. There must be a pulse. Draws
// into `file`; the caller commits it.
Status<OutputError> draw_curve_pulses(const CurvePulsesScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
