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

bool CommandedOutputs::set_halted(bool halted) {
  const BoardOutputs before = told_ ? for_board() : BoardOutputs{};
  halted_ = halted;
  return for_board() != before;
}

// The laser is at the output of the spindle's speed.
BoardOutputs CommandedOutputs::for_board() const {
  BoardOutputs outputs = board_outputs(in_force(), spindle_factor());
  const unsigned switches = in_motion_.switches.value_or(0);
  outputs.switches =
      static_cast<std::uint8_t>(outputs.switches | (halted_ || all_stand_ ? switches & kept_ : switches));
  const double power = std::min(laser_power() * spindle_factor(), 1.0);
  if (power <= 0) return outputs;
  outputs.switches = static_cast<std::uint8_t>(outputs.switches | OutputSwitch::spindle_on);
  outputs.spindle_rpm = static_cast<std::uint16_t>(std::lround(power * full_duty_rpm));
  return outputs;
}

}  // namespace passo
