// Whether moves to machine coordinates that a person may not expect, like those of M6, can begin.
#pragma once

#include "passo/session/machine_session.hpp"

namespace passo {

// Returns whether the position is known by homing, or a person has confirmed it. What a Grbl board reports when it is
// connected does not count: it may never have been homed.
bool is_place_confirmed(const MachineSession& session);

}  // namespace passo
