// Cuts a move that takes too long. Private to trajectory/.
#pragma once

#include <optional>

#include "passo/trajectory/phase.hpp"

namespace passo {

// Shortens the move so that it takes no longer than `longest`. Returns the rest of it; nothing where the move is short
// enough. A rest of less than `least_way` is not cut off.
std::optional<PlannedMove> shorten(PlannedMove& move, Seconds longest, Mm least_way = Mm(0));

}  // namespace passo
