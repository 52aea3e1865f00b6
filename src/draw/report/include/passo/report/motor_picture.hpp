// A picture of what a motor can do with its load. The upper chart shows torque over speed, with the start/stop region
// and the friction. The lower chart shows the acceleration that is left.
//
// Rates are full steps a second.
#pragma once

#include "passo/base/result.hpp"
#include "passo/motor/torque_curve.hpp"
#include "passo/report/picture.hpp"

namespace passo {

struct MotorScene {
  TorqueCurve curve;
  Load load = {};
  double margin = 1;  // share of the torque that may accelerate
  Hertz end;          // the axis of rates reaches at least this far
};

// `options.program` is the title, `options.machine` the line below it. Draws into `file`, which the caller commits.
Status<OutputError> draw_motor_picture(const MotorScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
