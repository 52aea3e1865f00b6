#include "passo/plant/fitted_plant.hpp"

#include <algorithm>
#include <utility>

namespace passo {
namespace {

// What is put together before a board drives the plant bounces no more when the board begins.
constexpr Seconds long_ago{-1e9};

}  // namespace

void FittedPlant::stand_at(const MotorSteps& steps) {
  std::ranges::copy(steps, positions_.begin());
  screws_.stand_at(positions_, slides_);
  set_switches(long_ago);
}

void FittedPlant::fit_screw(std::size_t motor, const ScrewModel& model) {
  screws_.fit(motor, model, positions_[motor]);
  set_switches(long_ago);
}

void FittedPlant::add(const TravelSwitch& added) {
  switches_.add(added);
  set_switches(long_ago);
}

void FittedPlant::add(const TouchBody& body) {
  switches_.add(body);
  set_switches(long_ago);
}

void FittedPlant::add(TouchSurface surface) {
  switches_.add(std::move(surface));
  set_switches(long_ago);
}

}  // namespace passo
