#include "passo/activity/cut_meter.hpp"

#include <variant>

#include "passo/path/hand_tool_change.hpp"

namespace passo {
namespace {

// A move of rotary axes alone has no length in mm, though the tool cuts.
bool moves_linearly(const Curve& curve) {
  const Point start = curve.start();
  const Point end = curve.end();
  bool turns = false;
  for (const Axis axis : all_axes) {
    if (start[axis] == end[axis]) continue;
    if (!is_rotary(axis)) return true;
    turns = true;
  }
  return !turns;  // a full circle ends where it begins
}

}  // namespace

void CutMeter::follow(const Action& action) {
  switch (action.kind) {
    case Action::Kind::feed_hold:
    case Action::Kind::await_line: return;  // not of the program: their outputs mean nothing
    case Action::Kind::probe_begin: probes_ = true; break;
    case Action::Kind::probe_end: probes_ = false; break;
    default: break;
  }
  outputs_ = action.outputs;
  if (changes_tool(action)) tool_ = action.tool;
}

void CutMeter::add(const Segment& segment, Mm length, Seconds time) {
  if (segment.rapid || segment.takes_up_backlash || probes_ || tool_ == 0) return;
  if (outputs_.spindle == SpindleDirection::off) return;
  CutAmount& amount = amounts_[tool_];
  if (moves_linearly(segment.curve)) amount.length += length;
  amount.time += time;
}

void CutMeter::watch(const MotionItem& motion) {
  const auto* const action = std::get_if<Action>(&motion);
  if (action != nullptr) {
    if (lead_in_ == 0) {
      follow(*action);
    } else if (action->kind != Action::Kind::feed_hold) {
      --lead_in_;
    }
    return;
  }
  const auto& move = std::get<PlannedMove>(motion);
  if (lead_in_ == 0) return add(move.segment, move.to - move.from(), move.duration());
  if (move.to >= move.segment.curve.length()) --lead_in_;
}

void CutMeter::watch(const PathItem& item, Seconds time, double share) {
  if (const auto* const action = std::get_if<Action>(&item)) return follow(*action);
  const auto& segment = std::get<Segment>(item);
  add(segment, segment.curve.length() * share, time * share);
}

}  // namespace passo
