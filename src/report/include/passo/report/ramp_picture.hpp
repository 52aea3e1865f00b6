// A picture of ramps: the rate over time of each method against the ideal line, the intervals, and the error of each
// interval in ticks; of moves with bounded jerk, the acceleration in place of the error.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

// One interval: of step `n`, in seconds from the start and in ticks.
struct RampSample {
  double n = 0;
  double begin = 0;
  double end = 0;
  double ticks = 0;
  double error = 0;  // ticks, against the exact interval
};

// What a method makes of the ramp. Of a long one only every so many intervals, but always the first and the last.
struct RampTrace {
  std::string name;
  std::vector<RampSample> samples;
};

struct RampPoint {
  double time = 0;   // s
  double value = 0;  // steps/s, or rad/s²
};

struct RampScene {
  std::vector<RampTrace> traces = {};  // at most three
  std::vector<RampPoint> ideal = {};   // the rate as it is meant
  std::string ideal_name = {};
  std::vector<RampPoint> acceleration = {};  // of the first trace; empty: the errors are drawn instead
  double tick = 1;                           // s
};

// options.program is the title, options.machine the line below it.
Status<OutputError> draw_ramp_picture(const RampScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
