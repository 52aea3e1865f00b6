// WindingEdges: the steps of a motor whose windings the board switches itself, read from the pins. The patterns are
// those of docs/follower.md. The firmware's own table is never used.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/chip/pin_map.hpp"
#include "passo/emulator/emulated_ports.hpp"

namespace passo {

struct WindingStep {
  std::uint64_t cycle = 0;  // of the first pin that changes
  bool down = false;
};

struct WindingEdges {
  std::vector<WindingStep> steps;
  std::uint64_t wrong = 0;  // patterns that are no neighbour of the one before
  std::int64_t apart = 0;   // the pins of one step, at the most, in cycles
};

// `place` in: where the motor stands in its table; out: where it has come to.
WindingEdges winding_edges(const MotorPins& motor, const std::vector<PortChange>& changes, int& place);

}  // namespace passo
