// The soonest stop: finds a stop for a motion that already uses its limits fully. Private to trajectory/.
//
// A plan that uses the limits fully leaves no room for a speed change with a fixed shape. But the fastest motion to a
// nearby stop can be found like any plan (JerkProfile): at each point it uses the remaining acceleration of the axes.
#pragma once

#include <optional>
#include <vector>

#include "feed_factors.hpp"
#include "path_ahead.hpp"
#include "path_state.hpp"
#include "speed_change.hpp"

namespace passo {

// Plans the fastest motion to a stop for several distances, and returns the one that takes the least time. Nothing if
// none was found.
std::optional<SpeedChange> soonest_stop(PathAhead& path, const PathState& from, const SpeedChange::Request& to_rest);

}  // namespace passo
