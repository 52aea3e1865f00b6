#include "passo/session/stop_cause.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/wire/message.hpp"

namespace passo {
namespace {

// "X", or "X or Y" where they share an input. Empty: there is no alarm.
std::string alarmed_axes(std::uint16_t inputs, const MachineDescription& machine) {
  std::string axes;
  for (const AxisDescription& axis : machine.axes) {
    if ((inputs & alarm_of(axis)) != 0) axes += (axes.empty() ? "" : " or ") + std::string{letter_of(axis.axis)};
  }
  return axes;
}

StopCause closed_limit_cause(unsigned input, const MachineDescription& machine) {
  const auto axis = std::ranges::find_if(machine.axes, [input](const AxisDescription& one) {
    return one.home && (one.home_switches() >> input & 1U) != 0;
  });
  if (axis == machine.axes.end()) {
    return {.what = fmt::format("limit switch {} closed", input + 1),
            .remedy = "jog off it (passo jog)",
            .kind = StopCause::Kind::limit_switch,
            .arguments = {{"number", std::to_string(input + 1)}}};
  }
  const char letter = letter_of(axis->axis);
  return {.what = fmt::format("the limit switch of {} closed", letter),
          .remedy = fmt::format("jog off it (passo jog {}{}2)", letter, axis->home->toward_high ? '-' : '+'),
          .kind = StopCause::Kind::limit_switch_of_axis,
          .arguments = {{"axis", std::string(1, letter)}}};
}

}  // namespace

StopCause stop_cause(std::uint16_t inputs, const MachineDescription& machine) {
  if ((inputs & input_emergency_stop) != 0) {
    return {.what = "the emergency stop was pressed", .remedy = "release it", .kind = StopCause::Kind::emergency_stop};
  }
  if (const std::string axes = alarmed_axes(inputs, machine); !axes.empty()) {
    return {.what = "the drive of " + axes + " reported an alarm",
            .remedy = "clear the drive's alarm",
            .kind = StopCause::Kind::drive_alarm,
            .arguments = {{"axes", axes}}};
  }
  for (unsigned input = 0; input < max_motors; ++input) {
    if ((inputs & (unsigned{input_limit} << input)) != 0) return closed_limit_cause(input, machine);
  }
  return {.what = "the board stopped its motors instantly", .remedy = ""};
}

}  // namespace passo
