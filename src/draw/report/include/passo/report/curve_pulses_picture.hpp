// A picture of both levels of interpolation on one curve: the curve, the chords of the coarse level, the pulses of the
// fine level on the grid of steps, and below them how far each pulse is from the curve.
//
// A curve that leaves the plane is seen from two sides, X Y and X Z.
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
  std::vector<Vector3> curve = {};     // places of the curve in mm, close to each other
  std::vector<StepPlace> chords = {};  // where chords end, the start included
  std::vector<CurvePulse> pulses = {};
  CurveMeasures measures = {};
};

// `options.program` is the title, `options.machine` tells how the chords were chosen. There is at least one pulse.
// Draws into `file`, which the caller commits.
Status<OutputError> draw_curve_pulses(const CurvePulsesScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
