// IdealPlant: a plant whose motors do at once all that they are told.
//
// The inputs that depend on the motors change only at pulses. The plant knows from the places of its switches how many
// pulses that takes. So a board gives most pulses as sums. Where nothing depends on the motors, the plant adds no cost
// to an event.
#pragma once

#include "passo/plant/plant.hpp"
#include "passo/plant/switches.hpp"

namespace passo {

class IdealPlant final : public Plant {
 public:
  // Gives the plant a spindle. Without a model the spindle turns as commanded, and has no encoder.
  void fit_spindle(const SpindleModel& model) { spindle_ = VirtualSpindle(model); }
  // Sets the motors' steps from machine zero. Call this and add() before a board drives the plant.
  void stand_at(const MotorSteps& steps);
  void add(const TravelSwitch& added);
  void add(const TouchBody& body);

  void pulse(Seconds time, const MotorSteps& steps) override;
  std::int64_t events_to_next_change() const override { return switches_.steps_to_next_change(positions_); }
  void command_spindle(Seconds time, double revolutions_per_minute) override {
    spindle_.command(time, revolutions_per_minute);
  }
  void set_switch(std::uint16_t which, bool closed) override { switches_.set(which, closed); }

  std::uint16_t inputs_at(Seconds /*time*/) override { return switches_.closed(); }
  const VirtualSpindle& spindle() const override { return spindle_; }
  Truth truth_at(Seconds time) override;

 private:
  MotorPositions positions_{};
  Switches switches_;
  VirtualSpindle spindle_;
};

}  // namespace passo
