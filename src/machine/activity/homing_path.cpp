#include "passo/activity/homing_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "passo/activity/stage_options.hpp"

namespace passo {
namespace {

constexpr double travels_to_seek = 1.1;
constexpr double pull_offs_to_latch = 3;
constexpr double hardly_a_step = 1e-3;

const AxisDescription* find(const MachineDescription& machine, Axis axis) {
  const auto found = std::ranges::find(machine.axes, axis, &AxisDescription::axis);
  return found == machine.axes.end() ? nullptr : &*found;
}

// Whether axis `i` of the order of homing and the next one seek at once.
bool is_same_turn(const MachineDescription& machine, std::size_t i) {
  const std::vector<int>& turns = machine.homing_turns;
  return i + 1 < machine.homing.size() && i + 1 < turns.size() && turns[i] == turns[i + 1];
}

// Rounds to whole steps, so that the axis rests on a step.
double pull_off_of(const AxisDescription& axis, double steps_per_unit) {
  return std::round(axis.home->pull_off * steps_per_unit) / steps_per_unit;
}

// How far the second motor falls behind, so that the first one's switch closes first.
double lag_of(const AxisDescription& axis, double steps_per_unit) {
  return std::max(std::round(axis.home->pull_off / 4 * steps_per_unit), 1.0) / steps_per_unit;
}

}  // namespace

Point home_rest(const MachineDescription& machine, const Point& start) {
  Point place = start;
  const Kinematics kinematics = kinematics_of(machine);
  for (const Axis letter : machine.homing) {
    const AxisDescription& axis = *find(machine, letter);
    const double pull_off = pull_off_of(axis, kinematics.steps_per_unit(letter));
    const double off = axis.home->toward_high ? -pull_off : pull_off;
    place[letter] = axis.home->switch_at + off;
  }
  return place;
}

HomingPath::HomingPath(const MachineDescription& machine, const MachineResults& answers, const Point& start)
    : machine_(machine), kinematics_(kinematics_of(machine)), answers_(answers), start_(start), position_(start) {
  begin_turn();
}

bool HomingPath::next(PathItem& item) {
  if (step_ == Step::judge) judge();
  if (axis_ == nullptr || fault_) return false;
  if (step_ == Step::begin) {
    step_ = Step::move;
    item = action(Action::Kind::probe_begin, position_);
    return true;
  }
  if (step_ == Step::move && !outcome().refused && target_ != position_) {
    step_ = Step::end;
    item = Segment{.curve = Curve::line(position_, target_), .speed = speed_, .mode = PathMode::exact_stop};
    return true;
  }
  step_ = Step::judge;
  item = action(Action::Kind::probe_end, outcome().refused ? position_ : target_);
  return true;
}

Action HomingPath::action(Action::Kind kind, const Point& place) const {
  return {.kind = kind, .probe_toward = watch_.until_closed(), .limit = watch_.inputs(), .place = place};
}

double HomingPath::off(double place) const {
  return place - direction() * pull_off_of(*axis_, steps_per_unit());
}

// Goes on with the axes of this turn, or else of the next one.
void HomingPath::begin_turn() {
  if (turn_.axes().empty() && homed_.size() < machine_.homing.size()) {
    std::size_t i = homed_.size();
    do turn_.add(*find(machine_, machine_.homing[i]));
    while (is_same_turn(machine_, i++));
  }
  axis_ = nullptr;
  if (turn_.axes().size() == 1) return begin_axis(*turn_.axes().front());
  if (!turn_.axes().empty()) seek_together();
}

// Every axis seeks at its own speed. The way ends where the first of them has gone as far as it may.
void HomingPath::seek_together() {
  double time = std::numeric_limits<double>::infinity();
  double squares = 0;
  unsigned limits = 0;
  for (const AxisDescription* axis : turn_.axes()) {
    const double own = travels_to_seek * (axis->travel_high - axis->travel_low) / axis->home->seek.value();
    if (own < time) axis_ = axis;
    time = std::min(time, own);
    squares += axis->home->seek.value() * axis->home->seek.value();
    limits |= axis->home_switches();
  }
  turn_.seek_together();
  watch_.wait_for_closing();
  begin(HomingStage::seek, stands());
  for (const AxisDescription* axis : turn_.axes()) {
    const double way = axis->home->seek.value() * time;
    target_[axis->axis] += axis->home->toward_high ? way : -way;
  }
  watch_.watch(limits);
  speed_ = MmPerSecond(std::sqrt(squares));
}

// Watches the switch of one axis without a move: the watch is refused if the switch is closed.
void HomingPath::begin_look(const AxisDescription& axis) {
  axis_ = &axis;
  watch_.wait_for_closing();
  begin(HomingStage::look, stands());
}

void HomingPath::begin_axis(const AxisDescription& axis) {
  axis_ = &axis;
  knows_switch_ = false;
  lag_ = lag_of(axis, steps_per_unit());
  watch_.begin_axis();
  motors_.begin_at(stands());
  begin(HomingStage::seek, stands() + direction() * travels_to_seek * (axis_->travel_high - axis_->travel_low));
}

// A move of the whole axis.
void HomingPath::begin(HomingStage stage, double target) {
  stage_ = stage;
  target_ = position_;
  target_[axis_->axis] = target;
  speed_ = stage == HomingStage::latch ? home().latch : home().seek;
  watch_.watch(axis_->home_switches());
  step_ = Step::begin;
}

void HomingPath::begin_alone(Alone alone, double way) {
  alone_ = alone;
  watch_.wait_for_closing();
  move_alone(way);
}

void HomingPath::move_alone(double way) {
  begin(HomingStage::square, stands() + way);
  speed_ = home().latch;
  const int input = alone_ == Alone::close_first ? home().input : axis_->second->input;
  watch_.watch(1U << static_cast<unsigned>(input));
}

// The machine rests after a move, and the outcome is known.
void HomingPath::judge() {
  const Point before = position_;
  if (!outcome().refused) position_ = outcome().rest;
  record_way(before);
  if (turn_.seeks_together()) return judge_together();
  switch (stage_) {
    case HomingStage::look: return judge_look();
    case HomingStage::square: return judge_alone();
    case HomingStage::seek:
    case HomingStage::latch: return judge_approach();
    case HomingStage::back_off:
    case HomingStage::pull_off: return judge_retreat();
  }
}

// Takes note of where the motors of the axis have gone, and of where the switch has closed. A contact that bounces
// closes again on the way off: that is not its place.
void HomingPath::record_way(const Point& before) {
  const double way = stands() - before[axis_->axis];
  const double to_contact = outcome().contact[axis_->axis] - before[axis_->axis];
  const bool retreats = stage_ == HomingStage::back_off || stage_ == HomingStage::pull_off;
  const bool has_closed = !outcome().refused && outcome().touched && watch_.until_closed() && !retreats;
  const std::optional<double> to_switch = has_closed ? std::optional(to_contact) : std::nullopt;
  for (const std::size_t motor : {HomedMotors::first, HomedMotors::second}) {
    const bool is_alone = stage_ == HomingStage::square;
    const bool is_first = alone_ == Alone::close_first;
    if (is_alone && is_first != (motor == HomedMotors::first)) continue;
    motors_.go(motor, way, to_switch);
  }
}

void HomingPath::judge_together() {
  if (!outcome().refused && !outcome().touched) return fail(MachineFault::switch_not_met);
  turn_.rest(outcome().refused ? std::nullopt : std::optional(outcome().contact));
  begin_look(*turn_.axes().front());
}

// The switch may have opened again by itself: then the first axis seeks alone.
void HomingPath::judge_look() {
  if (outcome().refused) return begin_axis(*axis_);
  if (const AxisDescription* const next = turn_.after(*axis_)) return begin_look(*next);
  begin_axis(*turn_.axes().front());
}

void HomingPath::judge_approach() {
  if (outcome().refused && stage_ == HomingStage::latch) {
    // The switch has closed by itself after the axis backed off.
    reverse_watch();
    return retreat(HomingStage::back_off, stands());
  }
  if (!outcome().refused && !outcome().touched) return fail(MachineFault::switch_not_met);
  if (stage_ == HomingStage::latch) {
    if (!is_pair()) return retreat(HomingStage::pull_off, off(motors_.found(HomedMotors::first)));
    return begin_alone(Alone::find_second, direction() * (lag_ + axis_->second->most_skew));
  }
  if (is_pair()) return begin_alone(Alone::close_first, direction() * axis_->second->most_skew);
  // A switch that is closed from the beginning.
  if (outcome().refused)
    return retreat(HomingStage::back_off, off(turn_.met() ? (*turn_.met())[axis_->axis] : stands()));
  knows_switch_ = true;
  retreat(HomingStage::back_off, off(motors_.found(HomedMotors::first)));
}

// The motors are whole steps apart before they go on together: otherwise they would not step at the same events.
void HomingPath::judge_alone() {
  const bool met = outcome().refused || outcome().touched;
  const bool is_free = alone_ == Alone::lag || alone_ == Alone::adjust;
  if (!settles_ && met == is_free)
    return fail(is_free ? MachineFault::switch_still_closed : MachineFault::switch_not_met);
  if (!settles_ && alone_ == Alone::find_second && outcome().refused) return fall_further_behind();
  const double apart = motors_.apart();
  const double steps = (alone_ == Alone::close_first ? apart : -apart) * steps_per_unit() * direction();
  const double left = std::ceil(steps - hardly_a_step) - steps;
  settles_ = !settles_ && left > hardly_a_step;
  if (!settles_) return go_on_alone();
  watch_.wait_for_opening();
  move_alone(direction() * left / steps_per_unit());
}

// The second motor's switch has closed before the first one's: after the fast seek their places were not known well.
void HomingPath::fall_further_behind() {
  if (!watch_.allows_another_try()) return fail(MachineFault::switch_unsteady);
  lag_ *= 2;
  retreat(HomingStage::back_off, off(stands()));
}

void HomingPath::go_on_alone() {
  switch (alone_) {
    case Alone::close_first: return begin_alone(Alone::close_second, direction() * axis_->second->most_skew);
    case Alone::close_second:
      knows_switch_ = true;
      return retreat(HomingStage::back_off, off(stands()) - direction() * motors_.farthest_beyond(direction()));
    case Alone::lag:
      watch_.wait_for_closing();
      return begin(HomingStage::latch,
                   stands() + direction() * pull_offs_to_latch * pull_off_of(*axis_, steps_per_unit()));
    case Alone::find_second:
      return retreat(HomingStage::pull_off,
                     stands() + off(motors_.found(HomedMotors::first)) - motors_.is_at(HomedMotors::first));
    case Alone::adjust: return end_axis();
  }
}

// Moves off the switch, which is closed at first.
void HomingPath::retreat(HomingStage stage, double target) {
  watch_.wait_for_opening();
  begin(stage, target);
}

// Tells whether the switch is open at the end of a retreat. The switch may open and close more than once on the way. So
// one watch follows the other, and each ends when the switch changes.
void HomingPath::judge_retreat() {
  const double target = target_[axis_->axis];
  if (outcome().refused || outcome().touched) {
    const bool is_first = !knows_switch_ && outcome().touched;
    knows_switch_ = knows_switch_ || outcome().touched;
    reverse_watch();
    return begin(stage_, is_first ? off(outcome().contact[axis_->axis]) : target);
  }
  if (!watch_.until_closed()) return fail(MachineFault::switch_still_closed);
  if (stage_ == HomingStage::back_off) {
    if (is_pair()) return begin_alone(Alone::lag, motors_.apart_from_switches() - direction() * lag_);
    begin(HomingStage::latch, stands() + direction() * pull_offs_to_latch * pull_off_of(*axis_, steps_per_unit()));
  } else if (is_pair()) {
    const double square = in_steps(axis_->second->square) / steps_per_unit();
    begin_alone(Alone::adjust, off(motors_.found(HomedMotors::second)) + square - motors_.is_at(HomedMotors::second));
  } else {
    end_axis();
  }
}

void HomingPath::reverse_watch() {
  if (!watch_.turn()) fault_ = MachineFault::switch_unsteady;
}

void HomingPath::end_axis() {
  const double found = in_steps(motors_.found(HomedMotors::first));
  HomedAxis homed{.axis = axis_->axis,
                  .way = (found - in_steps(start_[axis_->axis])) / steps_per_unit(),
                  .place = home().switch_at + (in_steps(motors_.is_at(HomedMotors::first)) - found) / steps_per_unit()};
  if (is_pair()) {
    homed.squared =
        (in_steps(motors_.is_at(HomedMotors::second)) - in_steps(motors_.is_at(HomedMotors::first))) / steps_per_unit();
  }
  homed_.push_back(homed);
  turn_.remove(*axis_);
  begin_turn();
}

double HomingPath::in_steps(double place) const {
  return std::round(place * steps_per_unit());
}

std::optional<double> HomingPath::progress() const {
  return static_cast<double>(homed_.size()) / static_cast<double>(std::max<std::size_t>(machine_.homing.size(), 1));
}

std::optional<ActivityFault> HomingPath::fault() const {
  if (!fault_) return {};
  return ActivityFault{.fault = *fault_};
}

Point HomingPath::place() const {
  Point place = start_;
  for (const HomedAxis& axis : homed_) place[axis.axis] = axis.place;
  return place;
}

}  // namespace passo
