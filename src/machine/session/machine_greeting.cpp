#include "machine_greeting.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "passo/activity/machine_plant.hpp"
#include "passo/link/twin_motors.hpp"

namespace passo {
namespace {

std::vector<MotorPair> motor_pairs(const MachineDescription& machine) {
  std::vector<MotorPair> pairs;
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    if (!axis.second) continue;
    const auto bit = [&](int input) { return static_cast<std::uint8_t>(axis.home ? 1U << unsigned(input) : 0U); };
    pairs.push_back({.first = static_cast<std::uint8_t>(m),
                     .second = machine.second_motor_of(m),
                     .opposite = axis.second->inverted != axis.inverted,
                     .first_switch = axis.home ? bit(axis.home->input) : std::uint8_t{0},
                     .second_switch = bit(axis.second->input)});
  }
  return pairs;
}

}  // namespace

Greeting with_machine(Greeting greeting, const MachineDescription& machine, bool over_a_line) {
  const auto tenths = [](Seconds time) { return static_cast<std::uint8_t>(std::lround(time.value() * 10)); };
  greeting.motors = machine.motor_count();
  greeting.setup = pin_setup(machine);
  if (over_a_line) greeting.setup.timing = step_timing(machine.board);
  greeting.pairs = motor_pairs(machine);
  greeting.silence = {.spindle = tenths(machine.silence.spindle),
                      .mist = tenths(machine.silence.mist),
                      .flood = tenths(machine.silence.flood)};
  return greeting;
}

}  // namespace passo
