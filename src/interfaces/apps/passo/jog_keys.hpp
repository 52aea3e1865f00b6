// Jogging by the keys of a terminal: an axis moves while its key is held.
//
// A terminal does not tell when a key is released, but it repeats a key that is held. So each key that comes renews a
// short lease. When no key comes any more, the machine brakes. The first repeat comes later than the other repeats. So
// a short press moves a short way, and a held key moves on after a moment.
#pragma once

#include "opened_machine.hpp"

namespace passo {

// Returns the exit code. `speed` is the speed at the beginning; the keys + and - change it.
int jog_by_keys(OpenedMachine& machine, const MachineDescription& description, MmPerSecond speed);

}  // namespace passo
