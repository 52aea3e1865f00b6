// Cuts a move that takes too long. Private to trajectory/.
#pragma once

#include <optional>

#include "passo/trajectory/phase.hpp"

namespace passo {

// Shortens the move so that it takes no longer than `longest`. Returns the rest of it; nothing where the move is short
// enough.
std::optional<PlannedMove> shorten(PlannedMove& move, Seconds longest);

}  // namespace passo
