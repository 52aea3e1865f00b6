#include "passo/plant/fitted_plant.hpp"

#include <algorithm>

namespace passo {

void FittedPlant::stand_at(const MotorSteps& steps) {
  std::ranges::copy(steps, positions_.begin());
  switches_.follow(positions_);
}

void FittedPlant::add(const TravelSwitch& added) {
  switches_.add(added);
  switches_.follow(positions_);
}

void FittedPlant::add(const TouchBody& body) {
  switches_.add(body);
  switches_.follow(positions_);
}

}  // namespace passo
