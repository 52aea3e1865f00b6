// IdealPlant: a plant whose motors follow every pulse immediately.
//
// Inputs that depend on the motors change only at pulses. The plant computes from the positions of its switches the
// number of pulses until then. So a board can pass most pulses as sums. If nothing depends on the motors, the plant
// adds no cost to an event.
#pragma once

#include "passo/plant/fitted_plant.hpp"

namespace passo {

class IdealPlant final : public FittedPlant {
 public:
  void pulse(Seconds time, const MotorSteps& steps) override;
  std::int64_t events_to_next_change() const override { return steps_to_next_switch(); }
  std::uint16_t inputs_at(Seconds time) override {
    if (switches().bounces()) set_switches(time);
    return switches().closed();
  }
  Truth truth_at(Seconds time) override {
    if (switches().bounces()) set_switches(time);
    return truth_now(time);
  }
};

}  // namespace passo
