#include "passo/controller/motion_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "board_outputs.hpp"
#include <fmt/format.h>

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

}  // namespace

BoardLine BoardLine::to(VirtualLine& line) {
  // A line may be slow, but a board that lives answers at once.
  return {.port = &line, .care = {.answer_within = Seconds(0.05), .session = 1}};
}

BoardLine BoardLine::to_board(BoardPort& board, std::uint16_t session, std::uint8_t greeting) {
  return {.port = &board,
          .care = {.answer_within = Seconds(0.1), .patience = Seconds(60), .session = session, .greeting = greeting},
          .real_time = true};
}

MotionDrive::MotionDrive(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps,
                         VirtualMachine& machine, const BoardLine& line)
    : tick_rate_(steps.clock.tick_rate),
      machine_(machine),
      port_(line.port != nullptr ? *line.port : machine),
      real_time_(line.real_time),
      watched_path_(path),
      path_(watched_path_),
      planner_(path_, limits),
      watched_motion_(planner_),
      step_generator_(watched_motion_, steps),
      watched_board_(step_generator_),
      link_(port_, steps.motor_count, line.care),
      steps_(steps),
      probe_(link_, steps),
      encoder_(0, tick_rate_),
      follower_(limits),
      rested_(now()) {
  watched_path_.watch([this](const PathItem& item) { look_at(item); });
  watched_motion_.watch([this](const MotionItem& item) { watch(item); });
}

std::optional<std::string> MotionDrive::unsuited() const {
  const auto& board = link_.board();
  if (link_.error() || !board) return {};  // the link says it
  if (static_cast<double>(board->clock) == tick_rate_.value()) return {};
  return fmt::format("its clock has {} ticks a second, and the machine file says {:.0f}", board->clock,
                     tick_rate_.value());
}

// Where something follows the spindle nothing is read far ahead from there on.
void MotionDrive::look_at(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  if (segment == nullptr || segment->lock == SpindleLock::none || !encoder_.exists() || refiller_) return;
  live_ = with_horizon(live_, SpindleLock::speed);
  if (ahead_.horizon > live_.horizon) commit_ahead(live_);
}

void MotionDrive::watch(const MotionItem& item) {
  planned_ += time_of(item);
  if (refiller_) refiller_->watch(item);
  const auto* move = std::get_if<PlannedMove>(&item);
  // With tails not all that is given is done.
  if (move != nullptr && probe_.is_running() && !refiller_) end_of_probe_ = move->segment.curve.at(move->to);
  if (encoder_.exists()) {
    // What is committed is blind to what the spindle does.
    if (move != nullptr) {
      follower_.watch(*move);
      if (move->segment.reverse_at > Mm(0)) watch_tap(*move);
      if (!refiller_) commit_ahead(with_horizon(commits(), follower_.lock()));
    } else if (!refiller_ && std::get<Action>(item).kind == Action::Kind::await_index) {
      commit_ahead(with_horizon(commits(), SpindleLock::place));
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

// Without a spindle to follow.
LiveOptions MotionDrive::commits() const {
  return probe_.is_running() ? probing_options : live_;
}

void MotionDrive::commit_ahead(const LiveOptions& options) {
  if (options == ahead_) return;
  ahead_ = options;
  planner_.limit_moves_to(options.longest_move);
  step_generator_.limit_waiting_to(std::min(options.longest_move, longest_wait));
}

void MotionDrive::use_tails(const TailOptions& options) {
  refiller_.emplace(
      Refiller::Stages{
          .path = path_, .planner = planner_, .generator = step_generator_, .items = watched_board_, .link = link_},
      steps_, options);
}

void MotionDrive::begin_at(const PathPlace& place) {
  path_.keep();
  path_.begin_at(place);
}

void MotionDrive::switch_on(const OutputState& outputs, Seconds spindle_wait) {
  assert(refiller_);
  OutputState spindle = outputs;
  spindle.mist = spindle.flood = false;
  refiller_->switch_outputs(board_outputs(spindle));
  if (spindle.spindle != SpindleDirection::off) let_pass(spindle_wait);
  if (spindle != outputs) refiller_->switch_outputs(board_outputs(outputs));
}

bool MotionDrive::advance_with_tails() {
  switch (refiller_->advance()) {
    case Refiller::Turn::lost_thread: return lose_thread();
    case Refiller::Turn::goes_on: return true;
    case Refiller::Turn::ended: state_ = State::ended; break;
    case Refiller::Turn::rests_in_hold: rest_in_feed_hold(); break;
    case Refiller::Turn::at_action: send(refiller_->take_action()); break;
  }
  return state_ != State::ended;
}

bool MotionDrive::advance() {
  if (state_ == State::ended) return false;
  if (state_ == State::held) return true;
  look_at_probe();
  if (follower_.lock() != SpindleLock::none) {
    follow_spindle();
  } else if (follows_ && !index_time_) {
    follows_ = false;
    commit_to_asked();
  }
  if (refiller_) return advance_with_tails();
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
  switch (action.kind) {
    case Action::Kind::probe_begin: return begin_probe(action);
    case Action::Kind::probe_end: return end_probe(action);
    case Action::Kind::feed_hold: return rest_in_feed_hold();
    case Action::Kind::await_index: return await_index(action.outputs);
    case Action::Kind::tap_turns: return turn_tap(action);
    default: break;
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

void MotionDrive::look_at_probe() {
  if (contact_seen_ || !probe_.contact()) return;
  contact_seen_ = true;
  if (refiller_) refiller_->brake_by_tail();
  if (probe_.is_running()) {
    probe_brakes_ = true;
    planner_.stop();  // whatever M53 says
  } else {
    stopped_by_probe_ = true;
    stop();
  }
}

void MotionDrive::guard_by_probe() {
  probe_.guard_other_moves();
  commit_to_asked();
}

// As much as is right for what the board is watched for now.
void MotionDrive::commit_to_asked() {
  if (!refiller_) return commit_ahead(commits());
  using Asking = Refiller::Asking;
  refiller_->ask(probe_.is_running() ? Asking::before_refills
                 : follows_          ? Asking::for_spindle
                 : probe_.guards()   ? Asking::with_refills
                                     : Asking::none);
}

void MotionDrive::begin_probe(const Action& action) {
  if (!refiller_) link_.drain();
  probe_.begin(action);
  contact_seen_ = false;
  end_of_probe_.reset();
  commit_to_asked();
}

void MotionDrive::end_probe(const Action& action) {
  if (!refiller_) link_.drain();
  probe_.end(end_of_probe_.value_or(action.place));
  commit_to_asked();
  contact_seen_ = false;
  // The contact may have come when the path was at its end already.
  if (std::exchange(probe_brakes_, false)) let_planner_go_on();
}

// Unless something else keeps it.
void MotionDrive::let_planner_go_on() {
  if (stopping_) return;
  planner_.resume();
  if (hold_asked_) planner_.hold();
}

void MotionDrive::rest_in_feed_hold() {
  if (std::exchange(probe_brakes_, false) || std::exchange(tap_brakes_, false)) {
    planner_.drop_to_action();
    if (refiller_) end_of_probe_ = refiller_->drop();
    let_planner_go_on();
  }
  // One that was resumed before it came to rest is none.
  const double feed = std::min({feed_override_, adaptive_feed_, feed_override_ * adaptive_feed_});
  if (hold_asked_ || stopping_ || feed < no_feed) rest_in_hold();
}

void MotionDrive::rest_in_hold() {
  if (stopping_) {
    if (refiller_) {
      refiller_->switch_outputs({});
    } else {
      link_.send(BoardOutputs{});
    }
    end();
    if (trouble_) link_.fail(*trouble_);
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
  if (state_ == State::ended || hold_asked_ || stopping_) return;
  hold_asked_ = true;
  planner_.hold();
  if (state_ == State::running) state_ = State::holding;
}

void MotionDrive::resume() {
  if (stopping_ || state_ == State::ended || !hold_asked_) return;
  hold_asked_ = false;
  if (!probe_brakes_) planner_.resume();
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

void MotionDrive::wait(Seconds time) {
  assert(state_ == State::held);
  let_pass(time);
}

void MotionDrive::listen(Seconds most) {
  assert(state_ == State::held);
  const Seconds from = now();
  link_.listen_for(most);
  rested_ += now() - from;
}

void MotionDrive::let_pass(Seconds time) {
  if (real_time_) {
    link_.let_pass(time);
    rested_ += time;
    return;
  }
  const Ticks ticks{std::llround(tick_rate_ * time)};
  machine_.wait(ticks);
  rested_ += in_seconds(ticks);
}

}  // namespace passo
