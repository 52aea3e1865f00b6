// The nominal time of a path: at its programmed speeds, without ramps. It is for progress, and never for motion.
#pragma once

#include "passo/path/segment.hpp"
#include "passo/trajectory/motion_limits.hpp"
#include "passo/trajectory/phase.hpp"
#include "passo/units/units.hpp"

namespace passo {

// How long an item takes at its programmed speed, within the axes' top speeds.
Seconds nominal_time_of(const PathItem& item, const MotionLimits& limits);
// Of a planned move: its share of its segment's.
Seconds nominal_time_of(const PlannedMove& move, const MotionLimits& limits);

}  // namespace passo
