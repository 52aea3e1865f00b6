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

// Where nothing hurries.
constexpr Seconds longest_wait{1000};

// Following a spindle: how far ahead is committed.
constexpr double moves_a_horizon = 5;
Seconds horizon_of(SpindleLock lock) {
  switch (lock) {
    case SpindleLock::place: return Seconds(0.01);
    case SpindleLock::speed: return Seconds(0.05);
    case SpindleLock::none: break;
  }
  return Seconds(std::numeric_limits<double>::infinity());
}

LiveOptions with_horizon(const LiveOptions& live, SpindleLock lock) {
  const Seconds horizon = horizon_of(lock);
  return {.horizon = std::min(live.horizon, horizon),
          .longest_move = std::min(live.longest_move, horizon / moves_a_horizon)};
}

// A spindle is at speed when a turn takes as long as it should, or hardly less than the one before.
constexpr double near_speed = 0.1;
constexpr double steady = 0.02;
constexpr int most_turns = 1000;

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
      watched_path_(path),
      planner_(watched_path_, limits),
      watched_motion_(planner_),
      step_generator_(watched_motion_, steps),
      watched_board_(step_generator_),
      link_(machine, steps.motor_count),
      follower_(limits),
      rested_(now()) {
  watched_path_.watch([this](const PathItem& item) { look_at(item); });
  watched_motion_.watch([this](const MotionItem& item) { watch(item); });
}

// Where something follows the spindle nothing is read far ahead from there on.
void MotionDrive::look_at(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  if (segment == nullptr || segment->lock == SpindleLock::none || !machine_.spindle().has_encoder()) return;
  live_ = with_horizon(live_, SpindleLock::speed);
  if (ahead_.horizon > live_.horizon) commit_ahead(live_);
}

void MotionDrive::watch(const MotionItem& item) {
  planned_ += time_of(item);
  const auto* move = std::get_if<PlannedMove>(&item);
  if (machine_.spindle().has_encoder()) {
    // What is committed is blind to what the spindle does.
    if (move != nullptr) {
      follower_.watch(*move);
      commit_ahead(with_horizon(live_, follower_.lock()));
    } else if (std::get<Action>(item).kind == Action::Kind::await_index) {
      commit_ahead(with_horizon(live_, SpindleLock::place));
    }
  }
  if (move == nullptr || move->segment.heeds.spindle_override == heeds_spindle_override_) return;
  heeds_spindle_override_ = move->segment.heeds.spindle_override;
  if (outputs_.spindle != SpindleDirection::off) set_outputs(outputs_);
}

void MotionDrive::go_live(const LiveOptions& options) {
  live_ = options;
  commit_ahead(options);
}

void MotionDrive::commit_ahead(const LiveOptions& options) {
  if (options == ahead_) return;
  ahead_ = options;
  planner_.limit_moves_to(options.longest_move);
  step_generator_.limit_waiting_to(std::min(options.longest_move, longest_wait));
}

bool MotionDrive::advance() {
  if (state_ == State::ended) return false;
  if (state_ == State::held) return true;
  if (follower_.lock() != SpindleLock::none) follow_spindle();
  if (committed() >= ahead_.horizon && link_.busy()) {
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
    const double feed = std::min({feed_override_, adaptive_feed_, feed_override_ * adaptive_feed_});
    if (hold_asked_ || stopping_ || feed < no_feed) rest_in_hold();
    return;
  }
  if (action.kind == Action::Kind::await_index) return await_index(action.outputs);
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
  if (state_ != State::ended && outputs_.spindle != SpindleDirection::off) set_outputs(outputs_);
}

void MotionDrive::stop() {
  if (state_ == State::ended) return;
  stopping_ = true;
  if (state_ == State::held) return rest_in_hold();
  planner_.stop();
  state_ = State::holding;
}

// At rest: until the spindle is at speed, and then until its index comes by.
void MotionDrive::await_index(const OutputState& outputs) {
  const VirtualSpindle& spindle = machine_.spindle();
  if (!spindle.has_encoder()) return;
  link_.drain();
  double before = 0;
  for (int i = 0; i < most_turns; ++i) {
    const Seconds from = now();
    const std::optional<Seconds> index = spindle.next_index(from);
    if (!index) return;
    // By two readings, so that the speed is known when the motion begins.
    let_pass((*index - from) / 2);
    follower_.read(spindle.read(now()));
    let_pass(*index - now());
    const double turn = (now() - from).value();
    const double wanted = seconds_per_minute / outputs.revolutions_per_minute;
    const bool at_speed = std::abs(turn - wanted) < near_speed * wanted || std::abs(turn - before) < steady * turn;
    before = turn;
    if (i > 0 && at_speed) break;
  }
  follower_.begin(spindle.read(now()));
}

// What was pulled last is followed by what is pulled next.
void MotionDrive::follow_spindle() {
  follower_.read(machine_.spindle().read(now()));
  if (const auto ratio = follower_.ratio(committed())) planner_.set_spindle_ratio(*ratio);
}

void MotionDrive::wait(Seconds time) {
  assert(state_ == State::held);
  let_pass(time);
}

void MotionDrive::let_pass(Seconds time) {
  const Ticks ticks{std::llround(tick_rate_ * time)};
  machine_.wait(ticks);
  rested_ += in_seconds(ticks);
}

}  // namespace passo
