#include "passo/controller/motion_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace passo {
namespace {

Seconds time_of(const MotionItem& item) {
  const auto* action = std::get_if<Action>(&item);
  return action != nullptr ? action->dwell : std::get<PlannedMove>(item).duration();
}

BoardOutputs board_outputs(const OutputState& state) {
  unsigned switches = 0;
  if (state.spindle != SpindleDirection::off) switches |= OutputSwitch::spindle_on;
  if (state.spindle == SpindleDirection::counterclockwise) switches |= OutputSwitch::spindle_reverse;
  if (state.mist) switches |= OutputSwitch::mist_on;
  if (state.flood) switches |= OutputSwitch::flood_on;
  const double rpm = std::clamp(std::round(state.revolutions_per_minute), 0.0, 65535.0);
  return {.switches = static_cast<std::uint8_t>(switches), .spindle_rpm = static_cast<std::uint16_t>(rpm)};
}

}  // namespace

MotionDrive::MotionDrive(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps,
                         VirtualMachine& machine)
    : tick_rate_(steps.clock.tick_rate),
      machine_(machine),
      planner_(path, limits),
      watched_motion_(planner_),
      step_generator_(watched_motion_, steps),
      watched_board_(step_generator_),
      link_(machine, steps.motor_count),
      probe_(link_, steps),
      rested_(now()) {
  watched_motion_.watch([this](const MotionItem& item) {
    planned_ += time_of(item);
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move != nullptr && probe_.is_running()) end_of_probe_ = move->segment.curve.at(move->to);
  });
}

void MotionDrive::go_live(const LiveOptions& options) {
  live_ = options;
  commit_by(options);
}

void MotionDrive::commit_by(const LiveOptions& options) {
  horizon_ = options.horizon;
  planner_.limit_moves_to(options.longest_move);
  step_generator_.limit_waiting_to(options.longest_move);
}

bool MotionDrive::advance() {
  if (state_ == State::ended) return false;
  if (state_ == State::held) return true;
  look_at_probe();
  if (committed() >= horizon_ && link_.busy()) {
    link_.wait();
  } else if (watched_board_.next(item_)) {
    send(item_);
  } else {
    return end();
  }
  return state_ != State::ended && (!link_.error() || end());
}

void MotionDrive::send(const BoardItem& item) {
  if (const auto* segment = std::get_if<BoardSegment>(&item)) return link_.send(*segment);
  const auto& action = std::get<Action>(item);
  switch (action.kind) {
    case Action::Kind::probe_begin: return begin_probe(action);
    case Action::Kind::probe_end: return end_probe(action);
    case Action::Kind::feed_hold: return rest_in_feed_hold();
    default: return link_.send(board_outputs(action.outputs));
  }
}

void MotionDrive::look_at_probe() {
  if (contact_seen_ || !probe_.contact()) return;
  contact_seen_ = true;
  if (probe_.is_running()) {
    probe_brakes_ = true;
    planner_.hold();
  } else {
    stopped_by_probe_ = true;
    stop();
  }
}

void MotionDrive::begin_probe(const Action& action) {
  link_.drain();
  probe_.begin(action);
  contact_seen_ = false;
  end_of_probe_.reset();
  commit_by(probing_options);
}

void MotionDrive::end_probe(const Action& action) {
  probe_.end(end_of_probe_.value_or(action.place));
  commit_by(live_);
  contact_seen_ = false;
  // The contact may have come when the path was at its end already.
  if (std::exchange(probe_brakes_, false) && state_ == State::running) planner_.resume();
}

void MotionDrive::rest_in_feed_hold() {
  if (probe_brakes_) {
    probe_brakes_ = false;
    planner_.drop_to_action();
    if (state_ == State::running) planner_.resume();
  }
  // One that was resumed before it came to rest is none.
  if (state_ == State::holding) rest_in_hold();
}

void MotionDrive::rest_in_hold() {
  if (stopping_) {
    link_.send(BoardOutputs{});
    end();
    return;
  }
  link_.drain();
  state_ = State::held;
}

bool MotionDrive::end() {
  link_.drain();
  state_ = State::ended;
  return false;
}

void MotionDrive::hold() {
  if (state_ != State::running) return;
  planner_.hold();
  state_ = State::holding;
}

void MotionDrive::resume() {
  if (stopping_ || (state_ != State::holding && state_ != State::held)) return;
  if (!probe_brakes_) planner_.resume();
  state_ = State::running;
}

void MotionDrive::stop() {
  if (state_ == State::ended) return;
  stopping_ = true;
  if (state_ == State::held) return rest_in_hold();
  hold();
}

void MotionDrive::wait(Seconds time) {
  assert(state_ == State::held);
  const Ticks ticks{std::llround(tick_rate_ * time)};
  machine_.wait(ticks);
  rested_ += in_seconds(ticks);
}

}  // namespace passo
