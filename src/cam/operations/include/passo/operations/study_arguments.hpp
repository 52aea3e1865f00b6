// The arguments of studies, which describe themselves by rows as the operations of `passo cam` do (cam_option.hpp). The
// initial value of a member is the default of its option, and is defined only here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/operations/cam_operation.hpp"

namespace passo {

// `passo tune`: limits for the motors of a machine.
struct TuneArguments {
  std::string machine;
  double margin = 0.3;        // of the weakest motors' torque
  std::string axes;           // "XY"; empty: all whose motors the file describes
  std::optional<double> way;  // of the reference move, mm or degrees; empty: half of the travel
  bool keep_velocity = false;
  std::string output;   // the machine file's copy; empty: none
  std::string picture;  // .svg or .png
  bool json = false;
};
std::vector<CamOption> cam_options_of(TuneArguments& arguments);

// The study `tune`, with the defaults of its options. Its input is the machine file, not a drawing.
const CamOperation& tune_study();

}  // namespace passo
