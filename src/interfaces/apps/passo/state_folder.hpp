// The folder in which this computer stores the state of boards.
#pragma once

#include <string>

namespace passo {

// Returns XDG_STATE_HOME/passo or ~/.local/state/passo. Empty: neither is known.
std::string state_folder();

}  // namespace passo
