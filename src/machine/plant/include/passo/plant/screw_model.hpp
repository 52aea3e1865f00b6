// ScrewModel: the screw between a motor and its slide: backlash, and errors of pitch. Screws: those of a plant's
// motors.
//
// The nut follows the motor only where the backlash is taken up. Then the slide stands where the pitch of the screw
// puts the nut. All places are in steps of the motor, from machine zero.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/plant/motor_steps.hpp"

namespace passo {

struct ScrewModel {
  // How far the motor turns after a reversal before the nut follows. With its sign: motor and nut stand at the same
  // place after motion in the direction of the sign, and the nut stands `backlash` further after motion the other way.
  double backlash = 0;
  struct Error {
    double at = 0;   // place of the nut by its screw's nominal pitch
    double off = 0;  // true place minus that place
  };
  // In ascending order of `at`. Between two the error is in proportion; beyond the ends it stays. `off` changes by less
  // than a hundredth of the way.
  std::vector<Error> errors = {};

  // The position of the slide for a position of the nut.
  double slide_at(double nut) const;
};

class Screws {
 public:
  // Replaces the screw of a motor that stands at `position`, with its backlash taken up in the direction of the
  // backlash's sign.
  void fit(std::size_t motor, const ScrewModel& model, double position);
  bool any() const { return !fitted_.empty(); }
  // Whether every pulse counts: a sum of pulses may hide a reversal.
  bool any_backlash() const;
  // Moves the nuts, and returns the positions of the slides.
  void follow(const MotorPositions& motors, MotorPositions& slides);
  // Puts the motors at other places, with the backlash taken up as in fit().
  void stand_at(const MotorPositions& motors, MotorPositions& slides);
  // How many steps the motors may make until a slide may have made `steps`. 1 or more.
  std::int64_t motor_steps_for(std::int64_t steps) const;

 private:
  struct Fitted {
    std::size_t motor = 0;
    ScrewModel model;
    double nut = 0;
  };

  std::vector<Fitted> fitted_;
};

}  // namespace passo
