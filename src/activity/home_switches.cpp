#include "passo/activity/home_switches.hpp"

#include <cmath>

namespace passo {

std::vector<TravelSwitch> home_switches(const MachineDescription& machine, const Point& start, Mm hysteresis) {
  std::vector<TravelSwitch> switches;
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    if (!axis.home) continue;
    const double scale = axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit;
    const bool high = axis.home->toward_high != axis.inverted;
    const auto closes = std::llround((axis.home->switch_at - start[axis.axis]) * scale);
    const auto later = std::llround(hysteresis.value() * axis.steps_per_unit);
    switches.push_back({.input = static_cast<std::uint16_t>(1U << static_cast<unsigned>(axis.home->input)),
                        .motor = static_cast<std::uint8_t>(m),
                        .at_high_end = high,
                        .closes_at = closes,
                        .opens_at = high ? closes - later : closes + later});
  }
  return switches;
}

}  // namespace passo
