// Cuts a move that takes too long. Private to trajectory/.
#pragma once

#include <optional>

#include "passo/trajectory/phase.hpp"

namespace passo {

// Shortens the move to at most `longest`. Returns the remaining move; nothing if the move is short enough. A remainder
// shorter than `least_way` is not cut off.
std::optional<PlannedMove> shorten(PlannedMove& move, Seconds longest, Mm least_way = Mm(0));

}  // namespace passo
