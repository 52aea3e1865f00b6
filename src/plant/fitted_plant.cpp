#include "passo/plant/fitted_plant.hpp"

#include <algorithm>

namespace passo {

void FittedPlant::stand_at(const MotorSteps& steps) {
  std::ranges::copy(steps, positions_.begin());
  screws_.stand_at(positions_, slides_);
  set_switches();
}

void FittedPlant::fit_screw(std::size_t motor, const ScrewModel& model) {
  screws_.fit(motor, model, positions_[motor]);
  set_switches();
}

void FittedPlant::add(const TravelSwitch& added) {
  switches_.add(added);
  set_switches();
}

void FittedPlant::add(const TouchBody& body) {
  switches_.add(body);
  set_switches();
}

}  // namespace passo
