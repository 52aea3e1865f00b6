// The phases of one cell whose speeds at both ends are decided, added to a move. Private to trajectory/.
#pragma once

#include "passo/trajectory/phase.hpp"

namespace passo {

// A straight cell: accelerate, cruise, brake, as fast as its limits let it. Each of the three is left out where it
// would take no way.
struct SpeedProfile {
  double start = 0;         // s
  double length = 0;        // mm
  double acceleration = 0;  // mm/s²
  double top_squared = 0;  // (mm/s)², as the next two; these are at most top, and their difference at most 2·a·length
  double entry_squared = 0;
  double exit_squared = 0;
};
void add_phases(const SpeedProfile& profile, PlannedMove& move);

// A curved cell: one phase from one speed to the other. A cruise goes on in the phase before it.
void add_phase(double start, double length, double entry_squared, double exit_squared, PlannedMove& move);

inline constexpr std::size_t most_phases_a_cell = 3;

}  // namespace passo
