// A valid machine file as text, and functions that make it invalid.
#pragma once

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "passo/machine_file/machine_description.hpp"

namespace passo {

inline const std::string sound_machine = R"(name = "Test machine"
path_tolerance_mm = 0.02

[board]
clock_hz = 16_000_000
max_event_rate_hz = 50_000
step_pulse_us = 2.5

[tool]
name = "Spindle"
max_rpm = 10000
diameter_mm = 3

[axis.X]
steps_per_mm = 100
travel_mm = [-150, 150]
max_velocity_mm_s = 25
max_acceleration_mm_s2 = 200

[axis.A]
steps_per_turn = 200
microsteps = 8
gear_ratio = 36
travel_deg = [-180, 180]
max_velocity_deg_s = 60
max_acceleration_deg_s2 = 300
inverted = true
)";

// Returns the text with the first `from` replaced. A missing `from` is an error in the test.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  if (place != std::string::npos) text.replace(place, from.size(), to);
  return text;
}

}  // namespace passo
