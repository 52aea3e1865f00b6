// FittedPlant: what every plant of this project has: switches, bodies for the probe, and a spindle. How its motors obey
// is left to the kinds of plants.
#pragma once

#include "passo/plant/plant.hpp"
#include "passo/plant/switches.hpp"

namespace passo {

class FittedPlant : public Plant {
 public:
  // Gives the plant a spindle. Without a model the spindle turns as commanded, and has no encoder.
  void fit_spindle(const SpindleModel& model) { spindle_ = VirtualSpindle(model); }
  // Sets the motors' steps from machine zero. Call this and add() before a board drives the plant.
  void stand_at(const MotorSteps& steps);
  void add(const TravelSwitch& added);
  void add(const TouchBody& body);

  void command_spindle(Seconds time, double revolutions_per_minute) override {
    spindle_.command(time, revolutions_per_minute);
  }
  void set_switch(std::uint16_t which, bool closed) override { switches_.set(which, closed); }
  const VirtualSpindle& spindle() const override { return spindle_; }

 protected:
  const MotorPositions& positions() const { return positions_; }
  // Every motor's position, between two settings of the switches.
  MotorPositions& moving_positions() { return positions_; }
  void set_switches() { switches_.follow(positions_); }
  const Switches& switches() const { return switches_; }

 private:
  MotorPositions positions_{};
  Switches switches_;
  VirtualSpindle spindle_;
};

}  // namespace passo
