// ScrewParts: divides a move into parts in which each motor is proportional to its axis, and gives the factors.
//
// A part ends where an axis reaches a border between entries of its screw's error table. The motor's position is
// continuous there, so a stretch of events continues. Machines without screws do not use it.
#pragma once

#include <array>
#include <span>

#include "motor_path.hpp"

#include "passo/path/segment.hpp"
#include "passo/stepgen/step_generator.hpp"

namespace passo {

class ScrewParts {
 public:
  explicit ScrewParts(const StepOptions& options);

  // Whether any motor has a screw.
  bool any() const { return any_; }
  void start_move(const Segment& segment) {
    downs_ = segment.downs;
    takes_up_backlash_ = segment.takes_up_backlash;
  }
  // The axes whose backlash is taken up for motion in the negative direction, in the current move or after the last
  // one.
  AxisSet downs() const { return downs_; }
  // Sets scale and offset of each motor with a screw for the part that begins at s = `from`. Returns where the part
  // ends: at `end` or before.
  double fit(const Curve& curve, double from, double end, std::span<MotorRow> motors) const;

 private:
  void fit_backlash(const Curve& curve, MotorRow& motor, double scale) const;

  std::array<double, max_motors> scales_{};  // steps per unit of a perfect screw
  bool any_ = false;
  AxisSet downs_;
  bool takes_up_backlash_ = false;
};

}  // namespace passo
