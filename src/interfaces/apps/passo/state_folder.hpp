// Where this computer keeps what it remembers of boards.
#pragma once

#include <string>

namespace passo {

// XDG_STATE_HOME/passo or ~/.local/state/passo. Empty: neither is known.
std::string state_folder();

}  // namespace passo
