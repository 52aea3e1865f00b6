#include "passo/activity/homing_path.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

constexpr double travels_to_seek = 1.1;
constexpr double pull_offs_to_latch = 3;
// How often a switch may open and close on the way off.
constexpr int most_turns = 8;

const AxisDescription* find(const MachineDescription& machine, Axis axis) {
  const auto found = std::ranges::find(machine.axes, axis, &AxisDescription::axis);
  return found == machine.axes.end() ? nullptr : &*found;
}

double in_steps(const AxisDescription& axis, double place) {
  return std::round(place * axis.steps_per_unit);
}

// Rounds to whole steps, so that the axis rests on a step.
double pull_off_of(const AxisDescription& axis) {
  return in_steps(axis, axis.home->pull_off) / axis.steps_per_unit;
}

}  // namespace

Point home_rest(const MachineDescription& machine, const Point& start) {
  Point place = start;
  for (const Axis letter : machine.homing) {
    const AxisDescription& axis = *find(machine, letter);
    const double off = axis.home->toward_high ? -pull_off_of(axis) : pull_off_of(axis);
    place[letter] = axis.home->switch_at + off;
  }
  return place;
}

std::string_view code_of(HomingFault fault) {
  switch (fault) {
    case HomingFault::not_met: return "home.not-met";
    case HomingFault::still_closed: return "home.still-closed";
    case HomingFault::unsteady: return "home.unsteady";
  }
  return "home.fault";
}

std::string_view message_of(HomingFault fault) {
  switch (fault) {
    case HomingFault::not_met: return "its switch was not met";
    case HomingFault::still_closed: return "its switch is still closed behind the pull-off";
    case HomingFault::unsteady: return "its switch opens and closes again and again";
  }
  return "its switch does what it should not";
}

HomingPath::HomingPath(const MachineDescription& machine, const MachineAnswers& answers, const Point& start)
    : machine_(machine), answers_(answers), start_(start), position_(start) {
  begin_axis();
}

bool HomingPath::next(PathItem& item) {
  if (step_ == Step::judge) judge();
  if (axis_ == nullptr || fault_) return false;
  Point end = position_;
  end[axis_->axis] = target_;
  if (step_ == Step::begin) {
    step_ = Step::move;
    item = action(Action::Kind::probe_begin, position_);
    return true;
  }
  if (step_ == Step::move && !outcome().refused && end != position_) {
    step_ = Step::end;
    item = Segment{.curve = Curve::line(position_, end),
                   .speed = stage_ == HomingStage::latch ? home().latch : home().seek,
                   .mode = PathMode::exact_stop};
    return true;
  }
  step_ = Step::judge;
  item = action(Action::Kind::probe_end, outcome().refused ? position_ : end);
  return true;
}

Action HomingPath::action(Action::Kind kind, const Point& place) const {
  return {.kind = kind,
          .probe_toward = until_closed_,
          .limit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(home().input)),
          .place = place};
}

double HomingPath::off(double place) const {
  return place - direction() * pull_off_of(*axis_);
}

void HomingPath::begin_axis() {
  axis_ = homed_.size() < machine_.homing.size() ? find(machine_, machine_.homing[homed_.size()]) : nullptr;
  if (axis_ == nullptr) return;
  turns_ = 0;
  knows_switch_ = false;
  until_closed_ = true;
  begin(HomingStage::seek, stands() + direction() * travels_to_seek * (axis_->travel_high - axis_->travel_low));
}

void HomingPath::begin(HomingStage stage, double target) {
  stage_ = stage;
  target_ = target;
  step_ = Step::begin;
}

// The machine rests after a move, and the outcome is known.
void HomingPath::judge() {
  if (!outcome().refused) position_ = outcome().rest;
  const bool approaches = stage_ == HomingStage::seek || stage_ == HomingStage::latch;
  approaches ? judge_approach() : judge_retreat();
}

void HomingPath::judge_approach() {
  const double contact = outcome().contact[axis_->axis];
  if (outcome().refused) {
    // The switch is closed: from the beginning, or because it has closed by itself after the axis backed off.
    if (stage_ == HomingStage::seek) return retreat(HomingStage::back_off, off(stands()));
    turn_watch();
    return retreat(HomingStage::back_off, stands());
  }
  if (!outcome().touched) {
    fault_ = HomingFault::not_met;
    return;
  }
  knows_switch_ = true;
  if (stage_ == HomingStage::seek) return retreat(HomingStage::back_off, off(contact));
  found_ = contact;
  retreat(HomingStage::pull_off, off(contact));
}

// Moves off the switch, which is closed at first.
void HomingPath::retreat(HomingStage stage, double target) {
  until_closed_ = false;
  begin(stage, target);
}

// Tells whether the switch is open at the end of a retreat. The switch may open and close more than once on the way. So
// one watch follows the other, and each ends when the switch changes.
void HomingPath::judge_retreat() {
  if (outcome().refused || outcome().touched) {
    if (!knows_switch_ && outcome().touched) {
      knows_switch_ = true;
      target_ = off(outcome().contact[axis_->axis]);
    }
    turn_watch();
    return begin(stage_, target_);
  }
  if (!until_closed_) {
    fault_ = HomingFault::still_closed;
  } else if (stage_ == HomingStage::back_off) {
    begin(HomingStage::latch, stands() + direction() * pull_offs_to_latch * pull_off_of(*axis_));
  } else {
    end_axis();
  }
}

void HomingPath::turn_watch() {
  until_closed_ = !until_closed_;
  if (++turns_ > most_turns) fault_ = HomingFault::unsteady;
}

void HomingPath::end_axis() {
  const double found = in_steps(*axis_, found_);
  homed_.push_back({.axis = axis_->axis,
                    .way = (found - in_steps(*axis_, start_[axis_->axis])) / axis_->steps_per_unit,
                    .place = home().switch_at + (in_steps(*axis_, stands()) - found) / axis_->steps_per_unit});
  begin_axis();
}

std::optional<double> HomingPath::progress() const {
  return static_cast<double>(homed_.size()) / static_cast<double>(std::max<std::size_t>(machine_.homing.size(), 1));
}

std::optional<ActivityFault> HomingPath::fault() const {
  if (!fault_) return {};
  return ActivityFault{.code = std::string(code_of(*fault_)), .message = std::string(message_of(*fault_))};
}

Point HomingPath::place() const {
  Point place = start_;
  for (const HomedAxis& axis : homed_) place[axis.axis] = axis.place;
  return place;
}

}  // namespace passo
