// ProbeWatch and ProbeReport: what a host watches its board's probe for, and what it has heard.
//
// The board tells every change of the probe with the motors' positions at that very event, and keeps those of the first
// since the watch began. So the place of a contact is known to the step, however late the host hears of it, and
// whatever was lost on the way. A limit switch may take the probe's place, to home an axis by it.
#pragma once

#include <array>
#include <cstdint>

#include "passo/wire/board_segment.hpp"

namespace passo {

enum class ProbeUntil : std::uint8_t {
  off,       // nobody cares
  touched,   // until it gets from free to touched
  released,  // until it gets from touched to free
};

struct ProbeReport {
  bool touched = false;   // the probe, as far as the host has heard
  bool happened = false;  // what is watched for
  std::array<std::int32_t, max_motors>
      steps{};  // of each motor from the beginning of the watch to that event, recalled
};

}  // namespace passo
