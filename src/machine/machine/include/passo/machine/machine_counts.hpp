// MachineCounts: the step statistics of a simulated machine. They are counted from the step pulses, not from the plan.
#pragma once

#include <array>
#include <cstdint>

#include "passo/units/units.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

struct MotorCounts {
  std::int64_t position = 0;   // steps up minus steps down
  std::int64_t total = 0;      // steps up and down
  std::int64_t reversals = 0;  // steps in the opposite direction to the step before
  Ticks last_step;             // the time of the last step; 0 without a step
  Ticks shortest_interval;     // between two steps; 0 with fewer than two steps
  friend bool operator==(const MotorCounts&, const MotorCounts&) = default;
};

struct MachineCounts {
  std::uint8_t motor_count = 0;
  std::array<MotorCounts, max_motors> motors;  // only the first motor_count count
  Ticks time;                                  // the time of the last event
  std::int64_t events = 0;                     // with or without steps
  Ticks shortest_event_interval;               // gives the highest event rate; 0 before the first event
  BoardOutputs outputs;                        // the current outputs
  std::int64_t output_changes = 0;
};

}  // namespace passo
