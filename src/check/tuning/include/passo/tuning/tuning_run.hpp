// TuningRun: proposes limits for the axes of a machine and verifies them by the analysis of `passo check`. Until the
// verdict is safe, it increases the margin of the axis or reduces its velocity.
#pragma once

#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/tuning/axis_tuner.hpp"
#include "passo/verdict/margin_survey.hpp"

namespace passo {

struct TunedMachine {
  MachineDescription machine;  // the machine, including the proposals
  std::vector<AxisTuning> axes;
  Verdict verdict = Verdict::safe;
  std::string program;  // the test program
};

struct TuningRequest {
  TuningWish wish;
  std::vector<Axis> axes;  // the axes whose motors the machine file describes
  bool keep_velocity = false;
};

// The message of a refusal begins with the axis.
Result<TunedMachine, TuningRefusal> tuned(const MachineDescription& machine, const TuningRequest& request);

// Returns a test program: strokes at four feeds, zigzags, all axes simultaneously, circles: at the limits of these
// axes, within their travel.
std::string tuning_program(const MachineDescription& machine, const std::vector<Axis>& axes);

}  // namespace passo
