// The limits that a machine file sets for feeds and speeds of tools.
#pragma once

#include "passo/machine_file/machine_description.hpp"
#include "passo/tooling/cutting_feeds.hpp"

namespace passo {

struct ToolLimits {
  SpindleRange spindle = {};
  MmPerSecond most_feed{0};    // of the slower one of X and Y; 0: unknown
  MmPerSecond most_plunge{0};  // of Z
};

ToolLimits tool_limits_of(const MachineDescription& machine);

}  // namespace passo
