#include "drilling_cycle.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

constexpr double same_height = 1e-9;      // mm: heights in inches differ by rounding, and need no move
constexpr double peck_clearance = 0.254;  // mm above the depth reached: a hundredth of an inch, as in LinuxCNC
constexpr double at_bottom = 1e-7;        // mm: a peck that ends this near to the bottom is the last one

}  // namespace

DrillingCycle::DrillingCycle(const DrillingPlan& plan, const OperationSource& source)
    : Cycle(plan.start, source), plan_(plan), holes_left_(plan.holes) {}

bool DrillingCycle::step() {
  if (!begun_) begin();
  if (!in_hole_ && !go_to_hole()) return false;
  if (pecks(plan_.code) && peck()) return true;
  finish_hole();
  in_hole_ = false;
  if (--holes_left_ > 0) return true;
  end();
  return false;
}

void DrillingCycle::begin() {
  begun_ = true;
  if (plan_.initial_height < plan_.retract - same_height) traverse_to(plan_.retract);
  const double between = plan_.returns_to_initial ? plan_.initial_height : plan_.retract;
  height_ = std::max(position_[plan_.axis], between);
  clear_ = std::max(plan_.retract, between);
  if (plan_.path_mode != PathMode::exact_path) emit(operation::SetPathMode{PathMode::exact_path, Mm(0)});
}

bool DrillingCycle::go_to_hole() {
  Point hole = plan_.hole;
  if (holes_left_ < plan_.holes && !find_hole(hole)) return false;
  hole[plan_.axis] = height_;
  traverse(hole);
  if (height_ > plan_.retract + same_height) traverse_to(plan_.retract);
  height_ = clear_;
  reached_ = plan_.retract;
  in_hole_ = true;
  return true;
}

// Finds a hole after the first one, from the tool's position. False: there is no angle to go on from.
bool DrillingCycle::find_hole(Point& hole) {
  if (plan_.way) hole = position_ + *plan_.way;
  if (!plan_.polar) return true;
  const double x = position_[Axis::x];
  const double y = position_[Axis::y];
  const double before = std::hypot(x, y);
  stuck_ = before == 0;
  const double radius = before + plan_.polar->radius;
  const double angle = std::atan2(y, x) + plan_.polar->angle;
  hole[Axis::x] = radius * std::cos(angle);
  hole[Axis::y] = radius * std::sin(angle);
  return !stuck_;
}

// False: the rest of the hole is the last peck.
bool DrillingCycle::peck() {
  reached_ -= plan_.peck;
  if (reached_ <= plan_.bottom + at_bottom) return false;
  feed_to(reached_);
  if (plan_.code == code(83)) traverse_to(plan_.retract);
  traverse_to(reached_ + plan_.clearance.value_or(peck_clearance));
  return true;
}

void DrillingCycle::finish_hole() {
  const CodeNumber number = plan_.code;
  if (taps(number)) return tap();
  if (number == code(87)) return bore_back();
  feed_to(plan_.bottom);
  if (dwells(number)) emit(operation::Dwell{Seconds(plan_.dwell)});
  if (stops_spindle(number)) emit(operation::TurnSpindle{});
  if (number == code(88)) emit(operation::ProgramStop{});
  if (number == code(85)) feed_to(plan_.retract);
  if (number == code(88) && plan_.retracts_by_hand) {
    position_[plan_.axis] = clear_;
  } else if (number == code(89)) {
    feed_to(clear_);
  } else {
    traverse_to(clear_);
  }
  if (stops_spindle(number)) emit(operation::TurnSpindle{plan_.spindle});
}

// The spindle is held at an angle. The tool, moved aside, goes down through the hole, goes back to the hole's axis and
// bores upwards. The tool leaves the hole in the same way.
void DrillingCycle::bore_back() {
  Point aside = plan_.aside;
  aside[plan_.axis] = 0;
  // LinuxCNC passes its number of the spindle's direction in place of M19's P.
  const auto way = static_cast<operation::OrientSpindle::Way>(static_cast<int>(plan_.spindle) + 1);
  const auto hold_spindle = [&] {
    emit(operation::TurnSpindle{});
    emit(operation::OrientSpindle{0, way});
  };
  traverse_by(aside);
  hold_spindle();
  traverse_to(plan_.bottom);
  traverse_by(Point{} - aside);
  emit(operation::TurnSpindle{plan_.spindle});
  feed_to(plan_.top);
  feed_to(plan_.bottom);
  hold_spindle();
  traverse_by(aside);
  traverse_to(clear_);
  traverse_by(Point{} - aside);
  emit(operation::TurnSpindle{plan_.spindle});
}

// Tapping with a floating holder: the tool goes in and out with feed F, and no override may change the feed meanwhile.
void DrillingCycle::tap() {
  const SpindleDirection out =
      plan_.spindle == SpindleDirection::clockwise ? SpindleDirection::counterclockwise : SpindleDirection::clockwise;
  emit(operation::SetFeedOverride{false});
  emit(operation::SetSpeedOverride{false});
  feed_to(plan_.bottom);
  emit(operation::TurnSpindle{});
  emit(operation::TurnSpindle{out});
  emit(operation::Dwell{Seconds(plan_.dwell)});
  feed_to(clear_);
  emit(operation::TurnSpindle{});
  emit(operation::TurnSpindle{plan_.spindle});
  if (plan_.feed_override) emit(operation::SetFeedOverride{true});
  if (plan_.speed_override) emit(operation::SetSpeedOverride{true});
}

void DrillingCycle::end() {
  if (plan_.path_mode == PathMode::exact_path) return;
  const bool continuous = plan_.path_mode == PathMode::continuous;
  emit(operation::SetPathMode{plan_.path_mode, continuous ? plan_.tolerance.path : Mm(0)});
  emit(operation::SetMergeTolerance{plan_.tolerance.merge});  // LinuxCNC gives both operations in any mode
}

void DrillingCycle::traverse_to(double height) {
  Point end = position_;
  end[plan_.axis] = height;
  traverse(end);
}

void DrillingCycle::feed_to(double height) {
  Point end = position_;
  end[plan_.axis] = height;
  feed(end);
}

}  // namespace passo
