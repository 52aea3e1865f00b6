// IdealPlant: a plant whose motors do at once all that they are told.
//
// The inputs that depend on the motors change only at pulses. The plant knows from the places of its switches how many
// pulses that takes. So a board gives most pulses as sums. Where nothing depends on the motors, the plant adds no cost
// to an event.
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
