#include "passo/plant/ideal_plant.hpp"

namespace passo {

void IdealPlant::pulse(Seconds time, const MotorSteps& steps) {
  MotorPositions& moving = moving_positions();
  for (std::size_t m = 0; m < steps.size(); ++m) moving[m] += static_cast<double>(steps[m]);
  set_switches(time);
}

}  // namespace passo
