// ScrewModel: the screw between a motor and its slide: backlash and pitch errors. Screws: the screws of all motors of a
// plant.
//
// The nut follows the motor only while the backlash is taken up. The pitch of the screw then determines the slide's
// position from that of the nut. All positions are in motor steps from machine zero.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/plant/motor_steps.hpp"

namespace passo {

struct ScrewModel {
  // The travel of the motor after a reversal before the nut follows. Its sign is a direction: after motion in that
  // direction, motor and nut have the same position; after motion in the opposite direction, the nut is `backlash`
  // further.
  double backlash = 0;
  struct Error {
    double at = 0;   // nominal position of the nut
    double off = 0;  // true position minus nominal position
  };
  // In ascending order of `at`. Between two entries the error is interpolated linearly; beyond the ends it is constant.
  // `off` changes by less than a hundredth of the distance.
  std::vector<Error> errors = {};

  // The position of the slide for a position of the nut.
  double slide_at(double nut) const;
};

class Screws {
 public:
  // Replaces the screw of a motor at `position`, with its backlash taken up in the direction of the backlash's sign.
  void fit(std::size_t motor, const ScrewModel& model, double position);
  bool any() const { return !fitted_.empty(); }
  // Whether every pulse must be processed, because a sum of pulses may hide a reversal.
  bool any_backlash() const;
  // Moves the nuts, and returns the positions of the slides.
  void follow(const MotorPositions& motors, MotorPositions& slides);
  // Sets the motors to other positions, with the backlash taken up as in fit().
  void stand_at(const MotorPositions& motors, MotorPositions& slides);
  // Returns how many steps the motors may make before a slide may have moved by `steps`. 1 or more.
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
