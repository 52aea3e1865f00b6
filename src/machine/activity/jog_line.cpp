#include "passo/activity/jog_line.hpp"

#include <algorithm>
#include <limits>

#include "passo/geometry/euclid.hpp"

namespace passo {

bool JogLine::next(PathItem& item) {
  if (given_) return false;
  given_ = true;
  item = Segment{.curve = Curve::line(start_, target_), .speed = speed_, .mode = PathMode::exact_stop};
  return true;
}

JogLine::JogLine(const MachineDescription& machine, const Point& start, const JogWay& jog, bool within_travel)
    : start_(start), target_(start), speed_(jog.speed) {
  const double length = length_of(jog.direction);
  if (!(length > 0)) return;
  double way = jog.distance > Mm(0) ? jog.distance.value() : std::numeric_limits<double>::infinity();
  for (const AxisDescription& axis : machine.axes) {
    const double part = jog.direction[axis.axis] / length;
    if (part == 0) continue;
    // A machine that does not know its place jogs no further than the length of its travel.
    const double end = part > 0 ? axis.travel_high : axis.travel_low;
    const double left = within_travel ? std::max(0.0, (end - start[axis.axis]) / part)
                                      : (axis.travel_high - axis.travel_low) / std::abs(part);
    way = std::min(way, left);
  }
  for (const AxisDescription& axis : machine.axes) {
    const double reached = start[axis.axis] + jog.direction[axis.axis] / length * way;
    if (jog.direction[axis.axis] == 0 || !(way > 0)) continue;
    // The clamp keeps rounding from leaving the travel.
    target_[axis.axis] = within_travel ? std::clamp(reached, axis.travel_low, axis.travel_high) : reached;
  }
}

}  // namespace passo
