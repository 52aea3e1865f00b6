// The nominal time of a path: at its programmed speeds, without ramps. It is used only to show progress.
#pragma once

#include "passo/path/segment.hpp"
#include "passo/trajectory/motion_limits.hpp"
#include "passo/trajectory/phase.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The time of an item at its programmed speed, within the axes' velocity limits. What the machine file inserts, such as
// a tool change, counts nothing: how long it takes depends on the operator, and the check leaves it out.
Seconds nominal_time_of(const PathItem& item, const MotionLimits& limits);
// The time of a planned move: a fraction of its segment's time.
Seconds nominal_time_of(const PlannedMove& move, const MotionLimits& limits);

}  // namespace passo
