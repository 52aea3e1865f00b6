// Jogging with the keys of a terminal: an axis moves while its key is held.
//
// A terminal does not report the release of a key, but it repeats a held key. Each received key therefore renews a
// short keep-alive timeout, and when no more keys arrive, the machine brakes. The first repetition comes later than the
// others: a short press makes a short move, and a held key continues after a moment.
#pragma once

#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

// Returns the exit code. `is_real`: the time of the session is that of the world. `speed` is the initial speed; the
// keys + and - change it.
int jog_by_keys(MachineSession& session, bool is_real, const MachineDescription& description, MmPerSecond speed);

}  // namespace passo
