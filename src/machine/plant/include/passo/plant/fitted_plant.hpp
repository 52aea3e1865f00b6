// FittedPlant: the common parts of all plants: screws, switches, objects for the probe, and a spindle. Derived classes
// define how the motors follow their pulses.
//
// Switches and the probe act on the slides. A slide without a screw model has the position of its motor.
#pragma once

#include "passo/plant/plant.hpp"
#include "passo/plant/screw_model.hpp"
#include "passo/plant/switches.hpp"

namespace passo {

class FittedPlant : public Plant {
 public:
  // Adds a spindle to the plant. Without a model the spindle turns as commanded, and has no encoder.
  void fit_spindle(const SpindleModel& model) { spindle_ = VirtualSpindle(model); }
  // Sets the motors' steps from machine zero. Call this and add() before a board drives the plant.
  void stand_at(const MotorSteps& steps);
  // Puts a screw between a motor and its slide. Its backlash is initially taken up in the direction of the backlash's
  // sign.
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
  // The position of every motor, to be changed between two updates of the switches.
  MotorPositions& moving_positions() { return positions_; }
  // Moves the slides with the motors. Call it at each change of a motor's direction.
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
  // The true state at `time`, with the motors and switches as last set.
  Truth truth_now(Seconds time) const {
    return {.positions = slides(), .spindle_turns = spindle_.turns_at(time), .inputs = switches_.closed()};
  }

 private:
  MotorPositions positions_{};
  MotorPositions slides_{};  // for motors with a screw
  Screws screws_;
  Switches switches_;
  VirtualSpindle spindle_;
};

}  // namespace passo
