#include "passo/drive/commanded_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace passo {

BoardOutputs board_outputs(const OutputState& state, double spindle_factor) {
  unsigned switches = 0;
  if (state.spindle != SpindleDirection::off) switches |= OutputSwitch::spindle_on;
  if (state.spindle == SpindleDirection::counterclockwise) switches |= OutputSwitch::spindle_reverse;
  if (state.mist) switches |= OutputSwitch::mist_on;
  if (state.flood) switches |= OutputSwitch::flood_on;
  const double rpm = std::clamp(std::round(state.revolutions_per_minute * spindle_factor), 0.0, 65535.0);
  return {.switches = static_cast<std::uint8_t>(switches), .spindle_rpm = static_cast<std::uint16_t>(rpm)};
}

}  // namespace passo
