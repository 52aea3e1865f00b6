#include "tool_limits.hpp"

#include <algorithm>

namespace passo {

ToolLimits tool_limits_of(const MachineDescription& machine) {
  ToolLimits limits{.spindle = {0, machine.tool.highest_rpm}};
  for (const AxisDescription& axis : machine.axes) {
    if (axis.axis == Axis::z) limits.most_plunge = axis.velocity;
    if (axis.axis != Axis::x && axis.axis != Axis::y) continue;
    const bool is_first = !(limits.most_feed > MmPerSecond(0));
    limits.most_feed = is_first ? axis.velocity : std::min(limits.most_feed, axis.velocity);
  }
  return limits;
}

}  // namespace passo
