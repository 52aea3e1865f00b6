#include "passo/motor/darlington.hpp"

namespace passo {

BaseResistor base_resistor_of(const Darlington& transistor, Amperes collector, Volts logic, double reserve,
                              Ohms chosen) {
  constexpr double on_in_two_phase_drive = 0.5;  // of the time
  const double across = logic.value - transistor.base_emitter.value;
  BaseResistor base;
  base.needed.value = collector.value / transistor.gain;
  base.wanted.value = base.needed.value * (1 + reserve);
  base.largest.value = across / base.wanted.value;
  base.given.value = across / chosen.value;
  base.overdrive = base.given.value / base.needed.value;
  base.heat.value = transistor.saturation.value * collector.value;
  base.warmer = base.heat.value * on_in_two_phase_drive * transistor.kelvin_per_watt;
  return base;
}

}  // namespace passo
