#include "passo/controller/motion_drive.hpp"

#include <cassert>
#include <cmath>
#include <vector>

#include "board_outputs.hpp"

namespace passo {
namespace {

Seconds time_of(const MotionItem& item) {
  const auto* action = std::get_if<Action>(&item);
  return action != nullptr ? action->dwell : std::get<PlannedMove>(item).duration();
}

}  // namespace

MotionDrive::MotionDrive(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps,
                         VirtualMachine& machine, const BoardLine& line)
    : tick_rate_(steps.clock.tick_rate),
      machine_(machine),
      path_(path),
      planner_(path_, limits),
      watched_motion_(planner_),
      step_generator_(watched_motion_, steps),
      watched_board_(step_generator_),
      link_(line.port != nullptr ? *line.port : machine, steps.motor_count, line.care),
      steps_(steps),
      rested_(now()) {
  watched_motion_.watch([this](const MotionItem& item) {
    planned_ += time_of(item);
    if (refiller_) refiller_->watch(item);
  });
}

void MotionDrive::go_live(const LiveOptions& options) {
  horizon_ = options.horizon;
  planner_.limit_moves_to(options.longest_move);
  step_generator_.limit_waiting_to(options.longest_move);
}

bool MotionDrive::use_tails(const TailOptions& options) {
  std::vector<PlannedMove> plan;
  if (!planner_.braking_plan(plan)) return false;
  refiller_.emplace(
      Refiller::Stages{
          .path = path_, .planner = planner_, .generator = step_generator_, .items = watched_board_, .link = link_},
      steps_, options);
  return true;
}

bool MotionDrive::advance_with_tails() {
  switch (refiller_->advance()) {
    case Refiller::Turn::goes_on: return true;
    case Refiller::Turn::ended: state_ = State::ended; break;
    // One that was resumed before it came to rest is none.
    case Refiller::Turn::rests_in_hold:
      if (state_ == State::holding) rest_in_hold();
      break;
  }
  return state_ != State::ended;
}

bool MotionDrive::advance() {
  if (state_ == State::ended) return false;
  if (state_ == State::held) return true;
  if (refiller_) return advance_with_tails();
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
  if (action.kind != Action::Kind::feed_hold) return link_.send(board_outputs(action.outputs));
  // One that was resumed before it came to rest is none.
  if (state_ == State::holding) rest_in_hold();
}

void MotionDrive::rest_in_hold() {
  if (stopping_) {
    link_.send(BoardOutputs{});
    end();
    return;
  }
  if (!refiller_) link_.drain();  // it has waited, and what came too late is never executed
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
  planner_.resume();
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
