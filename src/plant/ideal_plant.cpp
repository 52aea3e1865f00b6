#include "passo/plant/ideal_plant.hpp"

#include <algorithm>

namespace passo {

void IdealPlant::stand_at(const MotorSteps& steps) {
  std::ranges::copy(steps, positions_.begin());
  switches_.follow(positions_);
}

void IdealPlant::add(const TravelSwitch& added) {
  switches_.add(added);
  switches_.follow(positions_);
}

void IdealPlant::add(const TouchBody& body) {
  switches_.add(body);
  switches_.follow(positions_);
}

void IdealPlant::pulse(Seconds /*time*/, const MotorSteps& steps) {
  for (std::size_t m = 0; m < steps.size(); ++m) positions_[m] += static_cast<double>(steps[m]);
  switches_.follow(positions_);
}

Truth IdealPlant::truth_at(Seconds time) {
  return {.positions = positions_, .spindle_turns = spindle_.turns_at(time), .inputs = switches_.closed()};
}

}  // namespace passo
