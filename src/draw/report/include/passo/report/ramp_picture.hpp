// A picture of ramps. It has each method's rate over time beside the ideal line, the intervals, and the error of each
// interval in ticks. For moves with bounded jerk, the picture has the acceleration instead of the error.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

// The interval of step `n`: its start and end in seconds, and its length in ticks.
struct RampSample {
  double n = 0;
  double begin = 0;
  double end = 0;
  double ticks = 0;
  double error = 0;   // ticks, compared with the exact interval
  bool back = false;  // a step towards the start; its rate is drawn below zero
};

// The ramp as a method makes it. For a long ramp only some of the intervals are here, but always the first and the
// last.
struct RampTrace {
  std::string name;
  std::vector<RampSample> samples;
};

struct RampPoint {
  double time = 0;   // s
  double value = 0;  // steps/s (below zero: back), or rad/s²
};

struct RampScene {
  std::vector<RampTrace> traces = {};  // at most three
  std::vector<RampPoint> ideal = {};   // the intended rate
  std::string ideal_name = {};
  std::vector<RampPoint> acceleration = {};  // of the first trace; empty: the picture shows errors
  double tick = 1;                           // s
};

// options.program is the title, options.machine the line below it.
Status<OutputError> draw_ramp_picture(const RampScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
