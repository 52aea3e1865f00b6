// Jogging with the keys of a terminal: an axis moves while its key is held.
//
// A terminal does not report the release of a key, but it repeats a held key. Each received key therefore renews a
// short keep-alive timeout, and when no more keys arrive, the machine brakes. The first repetition comes later than the
// others: a short press makes a short move, and a held key continues after a moment.
#pragma once

#include "machine_connection.hpp"

namespace passo {

// Returns the exit code. `speed` is the initial speed; the keys + and - change it.
int jog_by_keys(MachineConnection& machine, const MachineDescription& description, MmPerSecond speed);

}  // namespace passo
