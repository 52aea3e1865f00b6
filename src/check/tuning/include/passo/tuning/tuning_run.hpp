// TuningRun: proposes limits for the axes of a machine, and lets the judge of `passo check` look at them. Where he is
// not content, the axis gets a larger margin, or a lower velocity, until he is.
#pragma once

#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/tuning/axis_tuner.hpp"
#include "passo/verdict/margin_survey.hpp"

namespace passo {

struct TunedMachine {
  MachineDescription machine;  // with the proposals
  std::vector<AxisTuning> axes;
  Verdict verdict = Verdict::safe;
  std::string program;  // that was judged
};

struct TuningRequest {
  TuningWish wish;
  std::vector<Axis> axes;  // whose motors the machine describes
  bool keep_velocity = false;
};

// The refusal's words begin with the axis.
Result<TunedMachine, TuningRefusal> tuned(const MachineDescription& machine, const TuningRequest& request);

// Strokes at four feeds, zigzags, all axes at once, circles: at the limits of these axes, within their travel.
std::string tuning_program(const MachineDescription& machine, const std::vector<Axis>& axes);

}  // namespace passo
