// Jogging by the keys of a terminal: an axis moves while its key is held.
//
// A terminal tells no key's release, but repeats a key that is held. So each key that comes renews a short lease; when
// none comes any more, the machine brakes. The first repeat comes later than the others: a short press is a short way,
// and a key that is held goes on after a moment.
#pragma once

#include "opened_machine.hpp"

namespace passo {

// The exit code. `speed`: to begin with; + and - change it.
int jog_by_keys(OpenedMachine& machine, const MachineDescription& description, MmPerSecond speed);

}  // namespace passo
