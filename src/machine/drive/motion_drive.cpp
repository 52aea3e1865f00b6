#include "passo/drive/motion_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "passo/drive/backlash_options.hpp"
#include "passo/drive/direct_feed.hpp"
#include "passo/path/run_up.hpp"

namespace passo {
namespace {

constexpr double no_feed = 0.01;

// The holds that somebody has to take back. A hold for a feed of zero ends by itself when the feed rises.
constexpr HoldReasons asked_holds{HoldReason::operator_hold, HoldReason::door,       HoldReason::program_stop,
                                  HoldReason::tool_change,   HoldReason::await_line, HoldReason::line_end,
                                  HoldReason::stop};

BacklashOptions backlash_of(StepOptions steps, const DriveOptions& options) {
  if (options.begin_at) steps.downs = AxisSet();
  return backlash_options(steps, options.tails || options.begin_at);
}

}  // namespace

MotionDrive::MotionDrive(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps,
                         BoardSession& board, AnswerBook& answers, const DriveOptions& options)
    : board_(board),
      answers_(answers),
      watched_path_(path),
      backlash_taker_(watched_path_, backlash_of(steps, options)),
      path_(backlash_taker_),
      line_stops_(path_),
      planner_(line_stops_, limits),
      watched_motion_(planner_),
      step_generator_(watched_motion_, steps),
      watched_items_(step_generator_),
      feed_(make_feed(options, steps)),
      probe_(board_, answers, steps.kinematics),
      spindle_({.planner = planner_, .feed = *feed_, .link = board_}, limits, options.counts_per_turn,
               steps.clock.tick_rate),
      pause_end_(options.not_before),
      spindle_wait_(options.spindle_wait),
      spindle_run_up_(options.spindle_run_up),
      waits_at_optional_(options.waits_at_optional) {
  line_stops_.stop_at_lines(options.stops_at_lines);
  backlash_taker_.ask_after_probe([this, motors = steps] { return backlash_at_rest(motors); });
  watched_path_.watch([this](const PathItem& item) { watch(item); });
  watched_motion_.watch([this](const MotionItem& item) { watch(item); });
  if (options.guards_by_probe) probe_.guard_other_moves();
  await_pause_end();
  // Whoever used the board before may have been stopped amid a probe move.
  script_.then([this] { probe_.ask_to_watch_others(); });
  script_.until([this] { return board_.settled(); });
  script_.then([this] { feed_->attend(attention()); });
}

MotionDrive::~MotionDrive() = default;

BacklashAtRest MotionDrive::backlash_at_rest(const StepOptions& steps) const {
  const AxisSet downs = step_generator_.downs();
  return {.downs = downs, .place = steps.kinematics.axes(step_generator_.place().exact(), downs, steps.start)};
}

std::unique_ptr<Feed> MotionDrive::make_feed(const DriveOptions& options, const StepOptions& steps) {
  if (options.begin_at || options.may_stop_at_lines) path_.keep();
  if (options.begin_at) path_.begin_at(*options.begin_at, options.lead_in);
  if (!options.tails && !options.may_stop_at_lines) path_.forget_passed();
  if (!options.tails) {
    auto direct = std::make_unique<DirectFeed>(DirectFeed::Stages{.path = path_,
                                                                  .planner = planner_,
                                                                  .generator = step_generator_,
                                                                  .items = watched_items_,
                                                                  .link = board_,
                                                                  .outputs = outputs_},
                                               DirectFeed::Options{.live = options.live,
                                                                   .follows_spindle = options.counts_per_turn > 0,
                                                                   .waits_for_operator = options.waits_for_operator,
                                                                   .reads_again = options.may_stop_at_lines});
    direct_ = direct.get();
    return direct;
  }
  auto refiller = std::make_unique<Refiller>(Refiller::Stages{.path = path_,
                                                              .planner = planner_,
                                                              .generator = step_generator_,
                                                              .items = watched_items_,
                                                              .link = board_,
                                                              .outputs = outputs_},
                                             steps, *options.tails, options.waits_for_operator);
  if (options.counts_per_turn > 0) refiller->guard_threads();
  refiller_ = refiller.get();
  return refiller;
}

void MotionDrive::go_live(const Commitment& live) {
  if (direct_ != nullptr) direct_->commit(live);
}

// From the first segment that follows the spindle, the feed no longer reads far ahead.
void MotionDrive::watch(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  if (segment == nullptr || segment->lock == SpindleLock::none || !spindle_.exists()) return;
  if (direct_ != nullptr) direct_->expect_thread();
}

void MotionDrive::watch(const MotionItem& item) {
  const auto* move = std::get_if<PlannedMove>(&item);
  if (move != nullptr && spindle_.exists()) spindle_.watch(*move);
  feed_->watch(item);
  if (move == nullptr) return;
  // Over a line, not all given motion is executed, so the end is not known here.
  if (probe_.is_running() && !feed_->is_remote()) end_of_probe_ = move->segment.tool_at(move->to);
  if (spindle_.exists() && move->segment.reverse_at > Mm(0)) watch_tap(*move);
  if (move->segment.heeds.spindle_override == outputs_.heeds_override()) return;
  outputs_.heed_override(move->segment.heeds.spindle_override);
  pass_on_outputs();
}

void MotionDrive::pass_on_outputs() {
  if (outputs_.is_news()) feed_->pass_on_outputs();
}

// On the tap's way down. At the end of the thread the spindle is reversed, and the tool follows the spindle as it slows
// down.
void MotionDrive::watch_tap(const PlannedMove& move) {
  end_of_tap_ = move.segment.tool_at(move.to);
  if (spindle_.expects_turn() || holds_.has(HoldReason::tap) || move.to < move.segment.reverse_at) return;
  spindle_.expect_turn();
  OutputState outputs = outputs_.ordered();
  outputs.spindle = reversed(outputs.spindle);
  outputs_.order(outputs);
  pass_on_outputs();
}

MotionDrive::Turn MotionDrive::advance() {
  if (state_ == State::ended) return Turn::ended;
  if (board_.standstill()) stop();
  if (!script_.go_on()) return Turn::waits;
  if (state_ == State::ended) return Turn::ended;
  if (state_ == State::held) return board_.error() ? end() : Turn::waits;
  look_at_probe();
  if (feed_->plans() && !follow()) return Turn::waits;
  return take(feed_->advance());
}

bool MotionDrive::turn(Seconds most) {
  const Turn turn = advance();
  if (turn == Turn::waits) wait(most);
  return turn != Turn::ended;
}

void MotionDrive::wait(Seconds most) {
  const bool held = state_ == State::held && script_.empty();
  if (held && std::isinf(most.value())) return;
  const Seconds from = now();
  board_.poll(std::max(std::min(most, due() - from), Seconds(0)));
  if (held || !script_.empty()) feed_->note_rest(now() - from);
}

// When the drive must look again even without news.
Seconds MotionDrive::due() const {
  const Seconds next = std::max(awaits_index_ ? spindle_.looks_at() : Seconds(0), pause_end_);
  return next - now() > hardly_any ? next : Seconds(std::numeric_limits<double>::infinity());
}

// False: the board has to answer first.
bool MotionDrive::follow() {
  if (spindle_.lock() == SpindleLock::none) {
    if (spindle_.let_go()) feed_->attend(attention());
    return true;
  }
  if (!spindle_.follow()) return false;
  if (spindle_.trouble()) stop();
  if (spindle_.turned_back()) change_holds(HoldReason::tap, true);
  return true;
}

MotionDrive::Turn MotionDrive::take(Feed::Turn turn) {
  holds_.set(HoldReason::line_lost, feed_->plays_tail());
  switch (turn) {
    case Feed::Turn::goes_on: break;
    case Feed::Turn::waits: return Turn::waits;
    case Feed::Turn::rests_in_hold: come_to_rest(); break;
    case Feed::Turn::at_action: act(feed_->take_action()); break;
    case Feed::Turn::lost_thread: lose_thread(); break;
    case Feed::Turn::outputs_off: switch_on_again(); break;
    case Feed::Turn::ended: return end();
  }
  return Turn::goes_on;
}

// Carries out an action. All that came before is executed, and the machine rests.
void MotionDrive::act(const Action& action) {
  switch (action.kind) {
    case Action::Kind::probe_begin: return begin_probe(action);
    case Action::Kind::probe_end: return end_probe(action);
    case Action::Kind::await_index: return await_index(action);
    case Action::Kind::tap_turns: return turn_tap(action);
    case Action::Kind::await_line: return await_line();
    default: return wait_for_operator(action);
  }
}

void MotionDrive::begin_probe(const Action& action) {
  script_.then([this, action] { probe_.ask_to_watch(action); });
  script_.until([this] { return board_.settled(); });
  script_.then([this, action] {
    probe_.begin(action, step_generator_.downs());
    contact_seen_ = false;
    end_of_probe_.reset();
    feed_->attend(attention());
  });
}

void MotionDrive::end_probe(const Action& action) {
  script_.then([this] { probe_.recall(); });
  script_.until([this] { return board_.settled(); });
  script_.then([this, place = action.place] {
    probe_.find(end_of_probe_.value_or(place));
    probe_.ask_to_watch_others();
  });
  script_.until([this] { return board_.settled(); });
  script_.then([this] {
    probe_.end();
    feed_->attend(attention());
    contact_seen_ = false;
    // The contact may have come when the path had already ended.
    change_holds(HoldReason::probe_contact, false);
  });
}

void MotionDrive::await_index(const Action& action) {
  if (!spindle_.exists()) return hold_speed(action);
  awaits_index_ = true;
  spindle_.begin_await(action.outputs.revolutions_per_minute);
  script_.until([this] { return spindle_.await_index(); });
  script_.then([this] {
    awaits_index_ = false;
    if (!spindle_.trouble()) return;
    holds_.add(HoldReason::stop);
    rest_in_hold();
  });
}

// The machine rests, and so does the spindle for a moment.
void MotionDrive::turn_tap(const Action& action) {
  outputs_.order(action.outputs);
  pass_on_outputs();
  script_.until([this] { return feed_->settled(); });
  script_.then([this] {
    answers_.note_tap_rest(end_of_tap_);
    spindle_.turn_round();
  });
}

// Pulled only when all before is executed, so the machine rests.
void MotionDrive::await_line() {
  holds_.add(HoldReason::await_line);
  rest_in_hold();
}

bool MotionDrive::pass_await_line(PathMode last) {
  if (direct_ == nullptr || state_ != State::running) return false;
  return planner_.go_on(last);
}

void MotionDrive::drop() {
  dropped_to_.reset();
  if (state_ != State::running && state_ != State::holding) return;
  feed_->brake();
  change_holds(HoldReason::drop, true);
}

void MotionDrive::look_at_probe() {
  if (contact_seen_ || !probe_.contact()) return;
  contact_seen_ = true;
  feed_->brake();
  if (probe_.is_running()) return change_holds(HoldReason::probe_contact, true);  // whatever M53 says
  stopped_by_probe_ = true;
  stop();
}

// What the drive watches the board for now.
Attention MotionDrive::attention() const {
  if (probe_.is_running()) return Attention::probes;
  if (spindle_.follows()) return Attention::follows;
  return probe_.guards() ? Attention::guards_probe : Attention::none;
}

void MotionDrive::change_holds(HoldReason reason, bool holds) {
  if (holds_.has(reason) == holds) return;
  holds_.set(reason, holds);
  tell_planner();
}

// The planner takes back both of its holds at once, so the one that remains is told again.
void MotionDrive::tell_planner() {
  const bool holds = holds_.any_of(heeded_holds);
  const bool stops = holds_.any_of(sure_holds);
  if ((planner_holds_ && !holds) || (planner_stops_ && !stops)) {
    planner_.resume();
    planner_holds_ = planner_stops_ = false;
  }
  if (holds && !std::exchange(planner_holds_, holds)) planner_.hold();
  if (stops && !std::exchange(planner_stops_, stops)) planner_.stop();
}

// The motion has come to rest. If the hold was taken back meanwhile, the machine does not stay at rest.
void MotionDrive::come_to_rest() {
  if (holds_.any_of({HoldReason::probe_contact, HoldReason::tap, HoldReason::drop})) {
    planner_.drop_to_action();
    if (const auto rest = feed_->drop()) end_of_probe_ = dropped_to_ = rest;
    holds_.remove(HoldReason::probe_contact);
    holds_.remove(HoldReason::tap);
    holds_.remove(HoldReason::drop);
    tell_planner();
  } else {
    rest_at_line();
  }
  if (holds_.any_of(lasting_holds)) rest_in_hold();
}

void MotionDrive::rest_in_hold() {
  if (!stopped()) {
    state_ = State::held;
    return;
  }
  switch_off_and_end(board_.standstill() ? LinkError::stood_still : spindle_.trouble());
  if (state_ == State::held) state_ = State::holding;
}

// The machine rests in a thread. The next turn of the thread would not be where the turns before are.
void MotionDrive::lose_thread() {
  switch_off_and_end(LinkError::thread_lost);
}

// At rest. `error`: why the work could not go on, if that is why it ends.
void MotionDrive::switch_off_and_end(std::optional<LinkError> error) {
  script_.then([this] { feed_->switch_outputs({}); });
  script_.until([this] { return feed_->settled(); });
  script_.then([this, error] {
    end();
    if (error) board_.fail(*error);
  });
}

MotionDrive::Turn MotionDrive::end() {
  state_ = State::ended;
  return Turn::ended;
}

void MotionDrive::hold(HoldReason reason) {
  if (state_ == State::ended || stopped() || holds_.has(reason)) return;
  change_holds(reason, true);
  if (state_ == State::running) state_ = State::holding;
}

void MotionDrive::resume(HoldReason reason) {
  if (state_ == State::ended || stopped() || !holds_.has(reason)) return;
  change_holds(reason, false);
  if (holds_.any_of(asked_holds)) return;
  if (state_ == State::held) let_outputs_go();
  state_ = State::running;
}

void MotionDrive::let_outputs_go() {
  const bool spindle_stands = outputs_.spindle_stands();
  if (!spindle_stands && !outputs_.all_stand()) return await_pause_end();
  outputs_.stop_spindle(false);
  outputs_.stop_all(false);
  switch_on(outputs_.ordered(), spindle_wait_);
}

void MotionDrive::set_feed_override(double factor) {
  feed_override_ = factor;
  planner_.set_feed_override(factor);
  mind_feed();
}

void MotionDrive::set_adaptive_feed(double factor) {
  adaptive_feed_ = factor;
  planner_.set_adaptive_feed(factor);
  mind_feed();
}

void MotionDrive::mind_feed() {
  const double feed = std::min({feed_override_, adaptive_feed_, feed_override_ * adaptive_feed_});
  holds_.set(HoldReason::zero_feed, feed < no_feed);
  if (state_ != State::held || holds_.any_of(asked_holds)) return;
  let_outputs_go();
  state_ = State::running;
}

void MotionDrive::set_spindle_override(double factor) {
  outputs_.set_override(factor);
  if (outputs_.is_news()) tell_outputs();
}

void MotionDrive::tell_outputs() {
  if (state_ == State::ended) return;
  if (state_ != State::held) return feed_->pass_on_outputs();
  script_.then([this] { feed_->switch_outputs(outputs_.tell()); });
  script_.until([this] { return feed_->settled(); });
}

void MotionDrive::switch_mist(bool on) {
  outputs_.switch_mist(on);
  tell_outputs();
}

void MotionDrive::switch_flood(bool on) {
  outputs_.switch_flood(on);
  tell_outputs();
}

void MotionDrive::stop_spindle(bool stands) {
  if (state_ != State::held || stopped()) return;
  if (stands == outputs_.spindle_stands()) return;
  outputs_.stop_spindle(stands);
  tell_outputs();
  if (!stands) pause_end_ = now() + run_up_time({}, outputs_.in_force(), spindle_run_up_);
}

void MotionDrive::await_pause_end() {
  script_.until([this] { return pause_end_ - now() <= hardly_any; });
}

void MotionDrive::stop_outputs() {
  if (state_ != State::held || stopped()) return;
  outputs_.stop_all(true);
  tell_outputs();
}

void MotionDrive::stop() {
  if (state_ == State::ended || stopped()) return;
  change_holds(HoldReason::stop, true);
  feed_->cut_dwell();
  if (std::exchange(awaits_index_, false))
    script_.clear();
  else if (state_ != State::held) {
    state_ = State::holding;
    return;
  }
  rest_in_hold();
}

void MotionDrive::switch_on(const OutputState& outputs, Seconds spindle_wait) {
  OutputState spindle = outputs;
  spindle.mist = spindle.flood = false;
  const auto order = [this](const OutputState& wanted) {
    script_.then([this, wanted] {
      outputs_.order(wanted);
      feed_->switch_outputs(outputs_.tell());
    });
    script_.until([this] { return feed_->settled(); });
  };
  order(spindle);
  if (spindle.spindle != SpindleDirection::off) {
    const Seconds wait = std::max(spindle_wait, run_up_time({}, spindle, spindle_run_up_));
    script_.then([this, wait] { pause_end_ = now() + wait; });
    await_pause_end();
  }
  if (spindle != outputs) order(outputs);
}

// The machine rests. What the program has ordered is as it was before motion goes on.
void MotionDrive::switch_on_again() {
  ++output_timeouts_;
  switch_on(outputs_.ordered(), spindle_wait_);
}

std::optional<std::string> unsuited(const BoardSession& board, const StepOptions& steps, bool wants_encoder) {
  const auto& hello = board.board();
  if (board.error() || !hello) return {};  // the session reports the error
  const double clock = steps.clock.tick_rate.value();
  if (static_cast<double>(hello->clock) != clock) {
    return fmt::format("its clock has {} ticks a second, and the machine file says {:.0f}", hello->clock, clock);
  }
  const auto& status = board.status();
  if (!status || !wants_encoder || (status->state & board_encodes) != 0) return {};
  return "it has no encoder, and [spindle] of the machine file tells of one";
}

}  // namespace passo
