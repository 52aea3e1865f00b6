// FittedPlant: what every plant of this project has: screws, switches, bodies for the probe, and a spindle. How its
// motors obey is left to the kinds of plants.
//
// Switches and the probe see the slides. A slide without a screw model has the position of its motor.
#pragma once

#include "passo/plant/plant.hpp"
#include "passo/plant/screw_model.hpp"
#include "passo/plant/switches.hpp"

namespace passo {

class FittedPlant : public Plant {
 public:
  // Gives the plant a spindle. Without a model the spindle turns as commanded, and has no encoder.
  void fit_spindle(const SpindleModel& model) { spindle_ = VirtualSpindle(model); }
  // Sets the motors' steps from machine zero. Call this and add() before a board drives the plant.
  void stand_at(const MotorSteps& steps);
  // Puts a screw between a motor and its slide. The backlash is taken up in the direction of its sign.
  void fit_screw(std::size_t motor, const ScrewModel& model);
  void add(const TravelSwitch& added);
  void add(const TouchBody& body);
  void add(TouchSurface surface);

  void command_spindle(Seconds time, double revolutions_per_minute) override {
    spindle_.command(time, revolutions_per_minute);
  }
  void set_switch(std::uint16_t which, bool closed) override { switches_.set(which, closed); }
  const VirtualSpindle& spindle() const override { return spindle_; }

 protected:
  const MotorPositions& positions() const { return positions_; }
  const MotorPositions& slides() const { return screws_.any() ? slides_ : positions_; }
  // Every motor's position, between two settings of the switches.
  MotorPositions& moving_positions() { return positions_; }
  // Lets the slides follow the motors. Call it at each change of a motor's direction.
  void move_slides() {
    if (screws_.any()) screws_.follow(positions_, slides_);
  }
  void set_switches(Seconds time) {
    move_slides();
    switches_.follow(time, slides());
  }
  std::int64_t steps_to_next_switch() const {
    return screws_.motor_steps_for(switches_.steps_to_next_change(slides()));
  }
  const Switches& switches() const { return switches_; }
  // What is true at `time`, with the motors and the switches as they were set last.
  Truth truth_now(Seconds time) const {
    return {.positions = slides(), .spindle_turns = spindle_.turns_at(time), .inputs = switches_.closed()};
  }

 private:
  MotorPositions positions_{};
  MotorPositions slides_{};  // where a motor has a screw
  Screws screws_;
  Switches switches_;
  VirtualSpindle spindle_;
};

}  // namespace passo
