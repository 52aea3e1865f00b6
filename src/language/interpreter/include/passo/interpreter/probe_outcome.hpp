// ProbeOutcome: the result of the last probe move. The drive writes it, and the stages that continue from there read
// it. No stage reads beyond a probe move before the machine has stopped.
#pragma once

#include "passo/geometry/axes.hpp"

namespace passo {

// All positions are in machine coordinates.
struct ProbeOutcome {
  bool refused = false;  // already triggered (G38.4, G38.5: open) before the move, so nothing moved
  bool touched = false;  // the expected change of the probe happened
  Point contact;         // its position, to the step; without a contact, that of the stop
  Point rest;            // the position at which the machine stopped
  friend bool operator==(const ProbeOutcome&, const ProbeOutcome&) = default;
};

}  // namespace passo
