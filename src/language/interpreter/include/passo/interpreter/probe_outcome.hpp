// ProbeOutcome: what a machine has found in its last probe move. The drive writes the outcome, and the stages that go
// on from there read it. No stage reads beyond a probe move before the machine has come to rest.
#pragma once

#include "passo/geometry/axes.hpp"

namespace passo {

// All places in machine coordinates.
struct ProbeOutcome {
  bool refused = false;  // already touched (G38.4, G38.5: free) before the move: nothing moved
  bool touched = false;  // the awaited change of the probe happened
  Point contact;         // where it happened, to the step; without contact, the rest
  Point rest;            // where the machine came to rest
  friend bool operator==(const ProbeOutcome&, const ProbeOutcome&) = default;
};

}  // namespace passo
