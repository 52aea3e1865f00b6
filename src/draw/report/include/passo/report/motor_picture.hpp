// A picture of the performance of a motor with its load. The upper chart shows torque over speed, with the start/stop
// region and the friction. The lower chart shows the available acceleration.
//
// Rates are full steps/s.
#pragma once

#include "passo/base/result.hpp"
#include "passo/motor/torque_curve.hpp"
#include "passo/report/picture.hpp"

namespace passo {

struct MotorScene {
  TorqueCurve curve;
  Load load = {};
  double margin = 1;  // fraction of the torque available for acceleration
  Hertz end;          // minimum value of the end of the rate axis
};

// `options.program` is the title, `options.machine` the line below it. Draws into `file`; the caller commits it.
Status<OutputError> draw_motor_picture(const MotorScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
