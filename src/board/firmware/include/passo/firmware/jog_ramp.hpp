// JogRamp: accelerates a manually moved motor from its start-stop speed to its highest speed. The ramp has stages,
// which a board plays as segments. Deceleration uses the same stages in reverse.
//
//   speed  ^            ________          Each stage changes the interval by the same amount at every event, so its
//          |         _/                   acceleration is largest at its fast end. A stage is long enough to keep the
//          |      _/                      acceleration limit even there.
//          |   __/
//          +--|--+--+--+---------> time
//
// The ramp is computed at compile time. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/board_segment.hpp"

namespace passo {

struct JogSpeeds {
  uint32_t start_stop = 0;    // steps/s: the motor starts and stops at this speed without a ramp
  uint32_t highest = 0;       // steps/s
  uint32_t acceleration = 0;  // steps/s²
  uint8_t tap = 1;            // steps for a short key press
};

inline constexpr uint8_t jog_stages = 24;
// Motion at the highest speed is played in pieces of 1/100 s.
inline constexpr uint8_t jog_pieces_a_second = 100;

struct JogRamp {
  struct Stage {
    uint16_t events = 0;
    uint32_t interval = 0;  // at the slow end, 16.16 ticks
    int32_t change = 0;     // at each event, during acceleration
  };
  Stage stages[jog_stages] = {};
  uint32_t shortest = 0;  // the shortest interval
  uint16_t piece = 0;     // events
  uint8_t tap = 0;

  constexpr uint32_t longest() const { return stages[0].interval; }
};

constexpr JogRamp jog_ramp(const JogSpeeds& speeds, uint32_t clock) {
  JogRamp ramp;
  const uint64_t ticks = uint64_t{clock} << 16;
  const uint64_t rise = speeds.highest - speeds.start_stop;
  for (uint8_t i = 0; i < jog_stages; ++i) {
    const uint64_t slow = speeds.start_stop + rise * i / jog_stages;
    const uint64_t fast = speeds.start_stop + rise * (i + 1U) / jog_stages;
    // The acceleration at the fast end is speed^3 times the change of the interval in seconds.
    const uint64_t events = 1 + fast * fast * (fast - slow) / (slow * speeds.acceleration);
    const auto from = static_cast<int64_t>(ticks / slow);
    const auto to = static_cast<int64_t>(ticks / fast);
    ramp.stages[i] = {.events = static_cast<uint16_t>(events),
                      .interval = static_cast<uint32_t>(from),
                      .change = static_cast<int32_t>((to - from) / static_cast<int64_t>(events))};
  }
  ramp.shortest = static_cast<uint32_t>(ticks / speeds.highest);
  ramp.piece = static_cast<uint16_t>(1 + speeds.highest / jog_pieces_a_second);
  ramp.tap = speeds.tap;
  return ramp;
}

// Whether the intervals fit into 32 bits and the changes into a segment.
constexpr bool can_ramp(const JogSpeeds& speeds, uint32_t clock) {
  if (speeds.acceleration == 0 || speeds.tap == 0 || speeds.highest <= speeds.start_stop) return false;
  return (uint64_t{clock} << 16) / largest_interval < speeds.start_stop;
}

}  // namespace passo
