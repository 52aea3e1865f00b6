// Adds the phases of one cell to a move. The speeds at both ends of the cell are decided.
#pragma once

#include <vector>

#include "cell.hpp"
#include "speed_window.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo {

// A straight cell: accelerate, cruise and decelerate, as fast as its limits allow. Parts without length are omitted.
struct SpeedProfile {
  double start = 0;         // s
  double length = 0;        // mm
  double acceleration = 0;  // mm/s²
  double top_squared = 0;  // (mm/s)², like the next two, which are at most this; their difference is at most 2·a·length
  double entry_squared = 0;
  double exit_squared = 0;
};
void add_phases(const SpeedProfile& profile, PlannedMove& move);

// Adds a curved cell: one phase from one speed to the other. A cruise lengthens the phase before it instead.
void add_phase(double start, double length, double entry_squared, double exit_squared, PlannedMove& move);

// The same for the part of a cell that the motion covers. Starts another move if the last one is full, or at the end of
// its segment.
void add_ride(const Segment& segment, const Cell& cell, double entry_squared, const Ride& ride,
              std::vector<PlannedMove>& plan);

inline constexpr std::size_t most_phases_a_cell = 3;

}  // namespace passo
