// The phases of one segment whose speeds at both ends are decided: accelerate, cruise, brake, as fast as its limits
// let it. Each of the three is left out where it would take no way.
#pragma once

#include "passo/trajectory/phase.hpp"

namespace passo {

struct SpeedProfile {
  double length = 0;        // mm
  double acceleration = 0;  // mm/s²
  double top_squared = 0;  // (mm/s)², as the next two; these are at most top, and their difference at most 2·a·length
  double entry_squared = 0;
  double exit_squared = 0;
};

// Replaces the move's phases.
void add_phases(const SpeedProfile& profile, PlannedMove& move);

}  // namespace passo
