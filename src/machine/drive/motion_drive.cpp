#include "passo/drive/motion_drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "make_feed.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// The holds that somebody has to take back. A hold for a feed of zero ends by itself when the feed rises.
constexpr HoldReasons asked_holds{HoldReason::operator_hold, HoldReason::door,       HoldReason::program_stop,
                                  HoldReason::tool_change,   HoldReason::await_line, HoldReason::line_end,
                                  HoldReason::stop};

}  // namespace

MotionDrive::MotionDrive(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps,
                         BoardSession& board, StoredResults& answers, const DriveOptions& options)
    : board_(board),
      answers_(answers),
      pipeline_(path, limits, steps, options),
      feed_(make_feed({.path = pipeline_.path(),
                       .planner = pipeline_.planner(),
                       .generator = pipeline_.generator(),
                       .items = pipeline_.items(),
                       .link = board_,
                       .outputs = outputs_},
                      steps, options)),
      probe_(board_, answers, steps.kinematics),
      spindle_({.planner = pipeline_.planner(), .feed = *feed_, .link = board_}, limits, options.counts_per_turn,
               steps.clock.tick_rate),
      switching_({.order = outputs_, .feed = *feed_, .link = board_, .script = script_, .spindle = options.spindle},
                 {.not_before = options.not_before,
                  .spindle_wait = options.spindle_wait,
                  .spindle_run_up = options.spindle_run_up,
                  .coolant_wait = options.coolant_wait}),
      holds_(pipeline_.planner()),
      waits_at_optional_(options.waits_at_optional) {
  outputs_.keep_in_stops(options.kept_in_stops);
  outputs_.apply(PathOutputs{.switches = options.switches});
  pipeline_.path_items().watch([this](const PathItem& item) { watch(item); });
  pipeline_.motion().watch([this](const MotionItem& item) { watch(item); });
  if (options.guards_by_probe) probe_.guard_other_moves();
  switching_.await_pause_end();
  // Whoever used the board before may have been stopped amid a probe move.
  script_.then([this] { probe_.ask_to_watch_others(); });
  script_.until([this] { return board_.settled(); });
  script_.then([this] { feed_->attend(attention()); });
}

MotionDrive::~MotionDrive() = default;

void MotionDrive::watch(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  if (segment != nullptr && segment->lock != SpindleLock::none && spindle_.exists()) feed_->expect_thread();
}

void MotionDrive::watch(const MotionItem& item) {
  const auto* move = std::get_if<PlannedMove>(&item);
  if (move != nullptr && spindle_.exists()) spindle_.watch(*move);
  feed_->watch(item);
  if (move == nullptr) return;
  // Over a line, not all given motion is executed, so the end is not known here.
  if (probe_.is_running() && !feed_->is_remote()) probe_.record_end(move->segment.tool_at(move->to));
  if (spindle_.exists() && move->segment.reverse_at > Mm(0)) watch_tap(*move);
  if (move->segment.heeds.spindle_override == outputs_.override_enabled()) return;
  outputs_.enable_override(move->segment.heeds.spindle_override);
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

MotionDrive::Progress MotionDrive::advance() {
  if (state_ == State::ended) return Progress::ended;
  if (board_.standstill()) stop();
  if (!script_.go_on()) return Progress::waits;
  if (state_ == State::ended) return Progress::ended;
  if (state_ == State::held) return board_.error() ? end() : Progress::waits;
  check_probe();
  if (feed_->plans() && !follow()) return Progress::waits;
  return handle(feed_->advance());
}

bool MotionDrive::poll(Seconds most) {
  const Progress turn = advance();
  if (turn == Progress::waits) wait(most);
  return turn != Progress::ended;
}

void MotionDrive::wait(Seconds most) {
  const bool held = state_ == State::held && script_.empty();
  if (held && std::isinf(most.value())) return;
  const Seconds from = now();
  board_.poll(std::max(std::min(most, due() - from), Seconds(0)));
  if (held || !script_.empty()) feed_->record_rest(now() - from);
}

// When the drive must look again even without news.
Seconds MotionDrive::due() const {
  const Seconds next = std::max(awaited_ == Awaited::index ? spindle_.next_poll() : Seconds(0), switching_.pause_end());
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
  if (spindle_.turned_back()) holds_.change(HoldReason::tap, true);
  return true;
}

MotionDrive::Progress MotionDrive::handle(Feed::Progress turn) {
  holds_.set(HoldReason::line_lost, feed_->plays_tail());
  switch (turn) {
    case Feed::Progress::goes_on: break;
    case Feed::Progress::waits: return Progress::waits;
    case Feed::Progress::rests_in_hold: come_to_rest(); break;
    case Feed::Progress::at_action: act(feed_->take_action()); break;
    case Feed::Progress::lost_thread: lose_thread(); break;
    case Feed::Progress::outputs_off:
      ++output_timeouts_;
      switching_.switch_on_again();
      await_speed();
      break;
    case Feed::Progress::ended: return end();
  }
  return Progress::goes_on;
}

// Carries out an action. All that came before is executed, and the machine rests.
void MotionDrive::act(const Action& action) {
  switch (action.kind) {
    case Action::Kind::probe_begin: return begin_probe(action);
    case Action::Kind::probe_end: return end_probe(action);
    case Action::Kind::await_index: return await_index(action);
    case Action::Kind::await_speed: return await_speed();
    case Action::Kind::tap_turns: return reverse_tap(action);
    case Action::Kind::await_line: return await_line();
    default: return wait_for_operator(action);
  }
}

void MotionDrive::begin_probe(const Action& action) {
  script_.then([this, action] { probe_.ask_to_watch(action); });
  script_.until([this] { return board_.settled(); });
  script_.then([this, action] {
    probe_.begin(action, pipeline_.generator().downs());
    feed_->attend(attention());
  });
}

void MotionDrive::end_probe(const Action& action) {
  script_.then([this] { probe_.recall(); });
  script_.until([this] { return board_.settled(); });
  script_.then([this, place = action.place] {
    probe_.find(place);
    probe_.ask_to_watch_others();
  });
  script_.until([this] { return board_.settled(); });
  script_.then([this] {
    probe_.end();
    feed_->attend(attention());
    // The contact may have come when the path had already ended.
    holds_.change(HoldReason::probe_contact, false);
  });
}

void MotionDrive::await_index(const Action& action) {
  if (!spindle_.exists()) return switching_.hold_speed(action);
  awaited_ = Awaited::index;
  spindle_.begin_await(action.outputs.revolutions_per_minute);
  script_.until([this] { return spindle_.await_index(); });
  script_.then([this] {
    awaited_ = Awaited::nothing;
    if (!spindle_.trouble()) return;
    holds_.set(HoldReason::stop);
    stop_in_hold();
  });
}

// A spindle that fails before it has reached its speed holds the machine, even where the program does not enable holds.
void MotionDrive::await_speed() {
  const HostSpindle* const spindle = switching_.host_spindle();
  if (spindle == nullptr) return;
  script_.then([this] { awaited_ = Awaited::speed; });
  script_.until([spindle] {
    const HostSpindleStatus status = spindle->status();
    return status.at_speed || status.has_failed();
  });
  script_.then([this, spindle] {
    awaited_ = Awaited::nothing;
    if (!spindle->status().has_failed()) return;
    holds_.set(HoldReason::operator_hold);
    stop_in_hold();
  });
}

// The machine rests, and so does the spindle for a moment.
void MotionDrive::reverse_tap(const Action& action) {
  outputs_.order(action.outputs);
  pass_on_outputs();
  script_.until([this] { return feed_->settled(); });
  script_.then([this] {
    answers_.record_tap_rest(end_of_tap_);
    spindle_.reverse();
  });
}

// Pulled only when all before is executed, so the machine rests.
void MotionDrive::await_line() {
  holds_.set(HoldReason::await_line);
  stop_in_hold();
}

bool MotionDrive::pass_await_line(PathMode last) {
  if (feed_->is_remote() || state_ != State::running) return false;
  return pipeline_.planner().go_on(last);
}

void MotionDrive::drop() {
  dropped_to_.reset();
  if (state_ != State::running && state_ != State::holding) return;
  feed_->brake();
  holds_.change(HoldReason::drop, true);
}

void MotionDrive::check_probe() {
  if (!probe_.is_new_contact()) return;
  feed_->brake();
  if (probe_.is_running()) return holds_.change(HoldReason::probe_contact, true);  // whatever M53 says
  stopped_by_probe_ = true;
  stop();
}

// What the drive watches the board for now.
Attention MotionDrive::attention() const {
  if (probe_.is_running()) return Attention::probes;
  if (spindle_.follows()) return Attention::follows;
  return probe_.guards() ? Attention::guards_probe : Attention::none;
}

// The motion has come to rest. If the hold was taken back meanwhile, the machine does not stay at rest.
void MotionDrive::come_to_rest() {
  if (holds_.any_of({HoldReason::probe_contact, HoldReason::tap, HoldReason::drop})) {
    pipeline_.planner().drop_to_action();
    if (const auto rest = feed_->drop()) {
      dropped_to_ = rest;
      probe_.record_end(*rest);
    }
    holds_.end({HoldReason::probe_contact, HoldReason::tap, HoldReason::drop});
  } else {
    rest_at_line();
  }
  if (holds_.any_of(lasting_holds)) stop_in_hold();
}

void MotionDrive::stop_in_hold() {
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
  switching_.switch_off();
  script_.then([this, error] {
    end();
    if (error) board_.fail(*error);
  });
}

MotionDrive::Progress MotionDrive::end() {
  state_ = State::ended;
  return Progress::ended;
}

void MotionDrive::hold(HoldReason reason) {
  if (state_ == State::ended || stopped() || holds_.has(reason)) return;
  holds_.change(reason, true);
  if (state_ == State::running) state_ = State::holding;
}

void MotionDrive::resume(HoldReason reason) {
  if (state_ == State::ended || stopped() || !holds_.has(reason)) return;
  holds_.change(reason, false);
  if (holds_.any_of(asked_holds)) return;
  leave_hold();
}

void MotionDrive::leave_hold() {
  if (state_ == State::held) {
    switching_.let_go();
    await_speed();
  }
  state_ = State::running;
}

void MotionDrive::set_feed_override(double factor) {
  holds_.set_feed_override(factor);
  change_feed();
}

void MotionDrive::set_adaptive_feed(double factor) {
  holds_.set_adaptive_feed(factor);
  change_feed();
}

// A machine that rested for a feed of zero goes on by itself.
void MotionDrive::change_feed() {
  if (state_ == State::held && !holds_.any_of(asked_holds)) leave_hold();
}

void MotionDrive::set_spindle_override(double factor) {
  outputs_.set_override(factor);
  if (outputs_.is_news()) send_outputs();
}

void MotionDrive::send_outputs() {
  if (state_ == State::ended) return;
  if (state_ != State::held) return feed_->pass_on_outputs();
  switching_.switch_as_ordered();
}

void MotionDrive::switch_mist(bool on) {
  outputs_.switch_mist(on);
  send_outputs();
}

void MotionDrive::switch_flood(bool on) {
  outputs_.switch_flood(on);
  send_outputs();
}

void MotionDrive::stop_spindle(bool stands) {
  if (state_ != State::held || stopped()) return;
  if (stands != outputs_.spindle_stands()) switching_.stop_spindle(stands);
}

void MotionDrive::stop_outputs() {
  if (state_ != State::held || stopped()) return;
  outputs_.stop_all(true);
  send_outputs();
}

void MotionDrive::stop() {
  if (state_ == State::ended || stopped()) return;
  holds_.change(HoldReason::stop, true);
  feed_->cut_dwell();
  if (std::exchange(awaited_, Awaited::nothing) != Awaited::nothing) {
    script_.clear();
  } else if (state_ != State::held) {
    state_ = State::holding;
    return;
  }
  stop_in_hold();
}

void MotionDrive::switch_on(const OutputState& outputs, Seconds spindle_wait) {
  switching_.switch_on(outputs, spindle_wait);
  await_speed();
}

std::optional<std::string> unsuited(const BoardSession& board, const StepOptions& steps, bool wants_encoder) {
  const auto& hello = board.board();
  if (board.error() || !hello) return {};  // the session reports the error
  const double clock = steps.clock.tick_rate.value();
  if (static_cast<double>(hello->clock) != clock) {
    return fmt::format("its clock has {} Hz, but clock_hz of the machine file is {:.0f}", hello->clock, clock);
  }
  const auto& status = board.status();
  if (!status || !wants_encoder || (status->state & board_encodes) != 0) return {};
  return "it has no spindle encoder, but [spindle] of the machine file has one";
}

}  // namespace passo
