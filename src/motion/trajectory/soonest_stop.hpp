// The soonest stop: a way to rest where a motion already uses up the limits. Private to trajectory/.
//
// A plan that uses limits to the full leaves no room for a change of speed of one shape. But the fastest motion to a
// rest nearby may be found as any plan is (JerkProfile): on each place of the way it uses what the axes have left.
#pragma once

#include <optional>
#include <vector>

#include "feed_factors.hpp"
#include "path_ahead.hpp"
#include "path_state.hpp"
#include "speed_change.hpp"

namespace passo {

// Of the fastest motions to rests after longer and longer ways, the one that takes the least time. Nothing where none
// was found.
std::optional<SpeedChange> soonest_stop(PathAhead& path, const PathState& from, const std::vector<LimitedAxis>& axes,
                                        const FeedFactors& feeds);

}  // namespace passo
