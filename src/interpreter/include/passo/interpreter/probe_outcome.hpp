// ProbeOutcome: what a machine has found in its last probe move. Written where the machine is driven, and read, down
// the street, by those who go on from there: no stage reads beyond a probe move before the machine has come to rest.
#pragma once

#include "passo/geometry/axes.hpp"

namespace passo {

// All places in machine coordinates.
struct ProbeOutcome {
  bool refused = false;  // it was touched (for G38.4 and G38.5: free) before the move began: nothing moved
  bool touched = false;  // what was waited for happened
  Point contact;         // where, to the step; without contact, the end of the move
  Point rest;            // where the machine came to rest
};

}  // namespace passo
