#include "passo/controller/jog.hpp"

#include <algorithm>
#include <limits>

#include "passo/controller/stage_options.hpp"
#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

StepOptions steps_from(const MachineDescription& description, const Point& start) {
  StepOptions options = step_options(description);
  options.start = start;
  return options;
}

}  // namespace

bool Jog::Line::next(PathItem& item) {
  if (given) return false;
  given = true;
  item = Segment{.curve = Curve::line(start, target), .speed = speed, .mode = PathMode::exact_stop};
  return true;
}

Jog::Line::Line(const MachineDescription& description, const Point& from, const JogRequest& request)
    : start(from), target(from), speed(request.speed) {
  const double length = length_of(request.direction);
  if (!(length > 0)) return;
  double way = request.distance > Mm(0) ? request.distance.value() : std::numeric_limits<double>::infinity();
  for (const AxisDescription& axis : description.axes) {
    const double part = request.direction[axis.axis] / length;
    if (part == 0) continue;
    const double end = part > 0 ? axis.travel_high : axis.travel_low;
    way = std::min(way, std::max(0.0, (end - start[axis.axis]) / part));
  }
  for (const AxisDescription& axis : description.axes) {
    const double reached = start[axis.axis] + request.direction[axis.axis] / length * way;
    const bool moves = request.direction[axis.axis] != 0 && way > 0;
    // Rounding does not leave the travel either.
    if (moves) target[axis.axis] = std::clamp(reached, axis.travel_low, axis.travel_high);
  }
}

Jog::Jog(const MachineDescription& description, VirtualMachine& machine, const Point& start, const JogRequest& request)
    : request_(request),
      path_(description, start, request),
      drive_(path_, motion_limits(description), steps_from(description, start), machine),
      place_(start) {
  drive_.go_live(request.live);
  drive_.motion().watch([this](const MotionItem& item) {
    if (const auto* move = std::get_if<PlannedMove>(&item)) place_ = move->segment.curve.at(move->to);
  });
  renew();
}

bool Jog::advance() {
  // The moves that one step asks for may not end behind the lease: they are committed then.
  const Seconds pulled = 3 * request_.live.longest_move;
  if (drive_.now() + drive_.committed() + pulled > lease_end_) drive_.stop();
  return drive_.advance();
}

}  // namespace passo
