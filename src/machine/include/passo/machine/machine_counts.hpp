// MachineCounts: what a virtual machine has done so far, counted at the motors' pulses and not taken from any plan.
#pragma once

#include <array>
#include <cstdint>

#include "passo/units/units.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

struct MotorCounts {
  std::int64_t position = 0;   // steps up less steps down
  std::int64_t total = 0;      // steps up and down
  std::int64_t reversals = 0;  // steps in the other direction than the step before
  Ticks last_step;             // when; 0 without a step
  Ticks shortest_interval;     // between two steps; 0 with fewer than two
  friend bool operator==(const MotorCounts&, const MotorCounts&) = default;
};

struct MachineCounts {
  std::uint8_t motor_count = 0;
  std::array<MotorCounts, max_motors> motors;  // the first motor_count
  Ticks time;                                  // of the last event
  std::int64_t events = 0;                     // with steps or without
  Ticks shortest_event_interval;               // the highest event rate seen; 0 before the first event
  BoardOutputs outputs;                        // as they are now
  std::int64_t output_changes = 0;
};

}  // namespace passo
