#include "passo/activity/machine_plant.hpp"

#include <cmath>

#include "passo/activity/stage_options.hpp"

namespace passo {

std::vector<TravelSwitch> home_switches(const MachineDescription& machine, Mm hysteresis) {
  std::vector<TravelSwitch> switches;
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    if (!axis.home) continue;
    const double scale = axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit;
    const bool high = axis.home->toward_high != axis.inverted;
    const auto closes = std::llround(axis.home->switch_at * scale);
    const auto later = std::llround(hysteresis.value() * axis.steps_per_unit);
    switches.push_back({.input = static_cast<std::uint16_t>(1U << static_cast<unsigned>(axis.home->input)),
                        .motor = static_cast<std::uint8_t>(m),
                        .at_high_end = high,
                        .closes_at = closes,
                        .opens_at = high ? closes - later : closes + later});
  }
  return switches;
}

SpindleModel spindle_model(const SpindleDescription& spindle) {
  return {.counts_per_turn = spindle.counts_per_turn,
          .run_up = spindle.run_up.value(),
          .droop = spindle.droop,
          .ripple = spindle.ripple,
          .ripple_rate = spindle.ripple_rate.value()};
}

IdealPlant plant_of(const MachineDescription& machine, const Point& stands_at, const std::vector<TouchBox>& boxes) {
  IdealPlant plant;
  plant.stand_at(steps_at(machine, stands_at));
  plant.fit_spindle(spindle_model(machine.spindle));
  for (const TravelSwitch& one : home_switches(machine)) plant.add(one);
  for (const TouchBox& box : boxes) plant.add(touch_body(box, machine));
  return plant;
}

}  // namespace passo
