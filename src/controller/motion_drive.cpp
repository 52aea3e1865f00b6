#include "passo/controller/motion_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace passo {
namespace {

Seconds time_of(const MotionItem& item) {
  const auto* action = std::get_if<Action>(&item);
  return action != nullptr ? action->dwell : std::get<PlannedMove>(item).duration();
}

constexpr double no_feed = 0.01;

BoardOutputs board_outputs(const OutputState& state, double spindle_factor) {
  unsigned switches = 0;
  if (state.spindle != SpindleDirection::off) switches |= OutputSwitch::spindle_on;
  if (state.spindle == SpindleDirection::counterclockwise) switches |= OutputSwitch::spindle_reverse;
  if (state.mist) switches |= OutputSwitch::mist_on;
  if (state.flood) switches |= OutputSwitch::flood_on;
  const double rpm = std::clamp(std::round(state.revolutions_per_minute * spindle_factor), 0.0, 65535.0);
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
      rested_(now()) {
  watched_motion_.watch([this](const MotionItem& item) { watch(item); });
}

void MotionDrive::watch(const MotionItem& item) {
  planned_ += time_of(item);
  const auto* move = std::get_if<PlannedMove>(&item);
  if (move == nullptr || move->segment.heeds.spindle_override == heeds_spindle_override_) return;
  heeds_spindle_override_ = move->segment.heeds.spindle_override;
  set_outputs(outputs_);
}

void MotionDrive::go_live(const LiveOptions& options) {
  horizon_ = options.horizon;
  planner_.limit_moves_to(options.longest_move);
  step_generator_.limit_waiting_to(options.longest_move);
}

bool MotionDrive::advance() {
  if (state_ == State::ended) return false;
  if (state_ == State::held) return true;
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
  if (action.kind == Action::Kind::feed_hold) {
    // One that was resumed before it came to rest is none.
    if (hold_asked_ || stopping_ || feed_override_ < no_feed || adaptive_feed_ < no_feed) rest_in_hold();
    return;
  }
  heeds_spindle_override_ = action.heeds.spindle_override;
  on_board_.reset();
  set_outputs(action.outputs);
}

void MotionDrive::set_outputs(const OutputState& outputs) {
  outputs_ = outputs;
  const BoardOutputs wanted = board_outputs(outputs, heeds_spindle_override_ ? spindle_override_ : 1);
  if (on_board_ && on_board_->switches == wanted.switches && on_board_->spindle_rpm == wanted.spindle_rpm) return;
  on_board_ = wanted;
  link_.send(wanted);
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
  if (state_ == State::ended || hold_asked_ || stopping_) return;
  hold_asked_ = true;
  planner_.hold();
  if (state_ == State::running) state_ = State::holding;
}

void MotionDrive::resume() {
  if (stopping_ || state_ == State::ended || !hold_asked_) return;
  hold_asked_ = false;
  planner_.resume();
  state_ = State::running;
}

void MotionDrive::set_feed_override(double factor) {
  feed_override_ = factor;
  planner_.set_feed_override(factor);
  if (state_ == State::held && !hold_asked_ && !stopping_) state_ = State::running;
}

void MotionDrive::set_adaptive_feed(double factor) {
  adaptive_feed_ = factor;
  planner_.set_adaptive_feed(factor);
  if (state_ == State::held && !hold_asked_ && !stopping_) state_ = State::running;
}

void MotionDrive::set_spindle_override(double factor) {
  spindle_override_ = factor;
  if (state_ != State::ended) set_outputs(outputs_);
}

void MotionDrive::stop() {
  if (state_ == State::ended) return;
  stopping_ = true;
  if (state_ == State::held) return rest_in_hold();
  planner_.stop();
  state_ = State::holding;
}

void MotionDrive::wait(Seconds time) {
  assert(state_ == State::held);
  const Ticks ticks{std::llround(tick_rate_ * time)};
  machine_.wait(ticks);
  rested_ += in_seconds(ticks);
}

}  // namespace passo
