// ScrewParts: cuts a move into parts in which each motor follows its axis in proportion, and tells the proportion.
//
// A part ends where an axis reaches a border of its screw's errors. The motor's place is continuous there, so a stretch
// of events goes on. Machines without screws never come here.
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
  // The axes whose backlash is taken up for motion down, in the present move or after the last one.
  AxisSet downs() const { return downs_; }
  // Sets scale and offset of each motor with a screw for the part that begins at s = `from`. Returns where the part
  // ends: at `end` or before.
  double fit(const Curve& curve, double from, double end, std::span<MotorRow> motors) const;

 private:
  void fit_backlash(const Curve& curve, MotorRow& motor, double scale) const;

  std::array<double, max_motors> scales_{};  // steps a unit of a perfect screw
  bool any_ = false;
  AxisSet downs_;
  bool takes_up_backlash_ = false;
};

}  // namespace passo
