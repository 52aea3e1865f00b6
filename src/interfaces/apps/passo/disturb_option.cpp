#include "disturb_option.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "program_input.hpp"

#include "passo/activity/machine_plant.hpp"

namespace passo {
namespace {

// Reads a number of 0 or more up to `end`, and leaves what follows `end`.
bool take_number(std::string_view& text, char end, double& value) {
  const std::size_t at = end == '\0' ? text.size() : text.find(end);
  if (at == std::string_view::npos) return false;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + at, value);
  const bool good = error == std::errc() && stop == text.data() + at && value >= 0 && value < 1e6;
  text.remove_prefix(std::min(at + 1, text.size()));
  return good;
}

std::optional<Disturbance> disturbance_of(std::string_view text, const MachineDescription& machine) {
  const auto axis = std::ranges::find_if(
      machine.axes, [&](const AxisDescription& one) { return !text.empty() && letter_of(one.axis) == text[0]; });
  if (axis == machine.axes.end() || !motor_setup(*axis) || text.size() < 2 || text[1] != ':') return std::nullopt;
  text.remove_prefix(2);
  double torque = 0;
  double from = 0;
  double time = 0;
  if (!take_number(text, '@', torque) || !take_number(text, ':', from) || !take_number(text, '\0', time)) {
    return std::nullopt;
  }
  return Disturbance{.motor = static_cast<std::size_t>(axis - machine.axes.begin()),
                     .torque = {torque},
                     .from = Seconds(from),
                     .until = Seconds(from + time)};
}

}  // namespace

std::optional<std::vector<Disturbance>> read_disturbances(const std::vector<std::string>& texts,
                                                          const MachineDescription& machine) {
  std::vector<Disturbance> disturbances;
  for (const std::string& text : texts) {
    const auto disturbance = disturbance_of(text, machine);
    if (!disturbance) {
      fail(exit_bad_program, "'" + text +
                                 "': expected --disturb AXIS:NM@FROM:SECONDS, e.g. X:0.8@1.5:0.2, with an axis whose "
                                 "motor is in the machine file");
      return std::nullopt;
    }
    disturbances.push_back(*disturbance);
  }
  return disturbances;
}

}  // namespace passo
