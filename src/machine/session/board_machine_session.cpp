#include "passo/session/board_machine_session.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

#include "machine_greeting.hpp"
#include "panel.hpp"
#include "work.hpp"

#include "passo/activity/stage_options.hpp"

namespace passo {
namespace {

// How many path items a check takes in one turn.
constexpr std::uint64_t items_a_turn = 2000;
// How many changes are kept until somebody takes them. Beyond that the oldest are dropped.
constexpr std::size_t most_changes = 4096;

// True: the error is one of the work, found by a user of the link. The board itself is as it was.
constexpr bool is_of_work(LinkError error) {
  switch (error) {
    case LinkError::too_few_places:
    case LinkError::no_encoder:
    case LinkError::spindle_stands:
    case LinkError::encoder_wrong:
    case LinkError::thread_lost:
    case LinkError::thread_outrun: return true;
    default: return false;
  }
}

constexpr MachineFault fault_of(LinkError error) {
  switch (error) {
    case LinkError::stopped: return MachineFault::board_stopped;
    case LinkError::drivers_off: return MachineFault::board_drivers_off;
    case LinkError::stood_still: return MachineFault::board_slipped;
    default: return MachineFault::board_lost;
  }
}

}  // namespace

BoardMachineSession::BoardMachineSession(const MachineDescription& machine, BoardPort& port,
                                         const SessionOptions& options)
    : machine_(machine),
      options_(options),
      board_(port, options.care),
      place_(machine, options.start),
      panel_(std::make_unique<Panel>(board_)) {
  options_.greeting = with_machine(options_.greeting, machine, options_.over_a_line);
}

BoardMachineSession::~BoardMachineSession() = default;

void BoardMachineSession::greet(const Greeting& greeting) {
  options_.greeting = with_machine(greeting, machine_, options_.over_a_line);
  greeted_ = true;
  board_.greet(options_.greeting);
}

void BoardMachineSession::name_session(std::uint16_t number) {
  options_.greeting.session = number;
  board_.name_session(number);
}

void BoardMachineSession::poll(Seconds most) {
  if (state_ == MachineState::offline) {
    go_online(most);
  } else if (state_ == MachineState::check) {
    poll_check();
  } else if (busy()) {
    poll_work(most);
  } else {
    board_.poll(std::isinf(most.value()) ? Seconds(0) : most);
  }
  check_board();
  poll_spindle();
  poll_panel();
  poll_place();
}

// Says hello. Before a second hello, asks the board for its status and its place.
void BoardMachineSession::go_online(Seconds most) {
  if (asks_place_) {
    if (!board_.settled()) board_.poll(most);
    if (!board_.settled() || board_.error()) return;
    asks_place_ = false;
    find_place_again();
    if (before_hello_) before_hello_(*board_.status(), options_.greeting);
    greet(options_.greeting);
  }
  if (!greeted_) greet(options_.greeting);
  if (!board_.ready()) board_.poll(most);
  if (!board_.ready()) return;
  const bool wants_encoder = options_.over_a_line && machine_.spindle.counts_per_turn > 0;
  if (const auto words = unsuited(board_, passo::step_options(machine_), wants_encoder)) {
    trouble_.sentence.text = *words;
    move_to(MachineEvent::lose_board);
    return;
  }
  if (std::exchange(switches_off_, false)) board_.send(BoardOutputs{});
  if (board_.busy()) board_.poll(most);
  if (board_.busy() || board_.error()) return;
  if (watches_counts() && !board_.status()) {
    if (board_.settled()) board_.inquire(Question::status);
    board_.poll(most);
    if (!board_.status()) return;
  }
  enabled_at_ = now();
  place_.forget_board();
  stand_at(position());
  move_to(MachineEvent::ready);
}

void BoardMachineSession::stand_at(const KnownPosition& position) {
  place_.stand_at(position, watched_status());
  ++version_;
}

// What the board has told last, if its counts are compared with what was commanded.
const BoardStatus* BoardMachineSession::watched_status() const {
  return watches_counts() && board_.status() ? &*board_.status() : nullptr;
}

void BoardMachineSession::begin_reset() {
  board_.hang_up();
  trouble_ = {};
  greeted_ = false;
  switches_off_ = true;
  asks_place_ = options_.over_a_line;
  if (asks_place_) board_.inquire(Question::status);
  place_.doubt();
  move_to(MachineEvent::reset);
}

// A board that knows the session and has lost no step has gone on counting. Then its counts tell the place.
void BoardMachineSession::find_place_again() {
  const BoardStatus& status = *board_.status();
  const bool knows = status.session == options_.greeting.session && status.motors == machine_.motor_count() &&
                     (status.state & board_trusted) != 0 && (status.state & (board_manual | board_moves)) == 0;
  place_.find_again(status, knows);
}

// A check needs no board, but hears what the board says.
void BoardMachineSession::poll_check() {
  board_.poll(Seconds(0));
  if (!work_->stopped && !work_->checker->go_on(items_a_turn)) return;
  end_work();
}

void BoardMachineSession::poll_work(Seconds most) {
  if (work_->stage == Work::Stage::asks_counts) {
    if (!board_.settled()) board_.poll(most);
    if (board_.settled()) end_work();
    return;
  }
  check_lease();
  if (poll_lines(most)) return;
  const MotionDrive::Progress turn = work_->drive->advance();
  if (turn == MotionDrive::Progress::ended) return finish_work();
  PlannedAhead& ahead = work_->ahead;
  if (ahead.plans_program_end() && ahead.take_program_end(clock_of(*work_))) end_overrides();
  update_holds();
  update_door();
  if (turn != MotionDrive::Progress::waits) return;
  const bool held = work_->drive->state() == MotionDrive::State::held;
  if (held && options_.over_a_line) most = std::min(most, Panel::in_a_hold);
  work_->drive->wait(most);
}

// The drive has ended. Over a line, the board is asked where it stands. A limit switch that was closed may be open now.
void BoardMachineSession::finish_work() {
  report_tails();
  const bool asks = watches_counts() || closed_limit();
  if (!asks || board_.error()) return end_work();
  work_->stage = Work::Stage::asks_counts;
  board_.inquire(Question::status);
}

void BoardMachineSession::end_work() {
  // The standstill may have been heard of when the drive had ended already.
  on_standstill();
  if (board_.standstill()) board_.fail(LinkError::stood_still);
  const bool knows_counts = std::exchange(work_->stage, Work::Stage::ended) == Work::Stage::asks_counts;
  if (work_->ahead.take_program_end()) end_overrides();
  Outcome outcome = Outcome::done;
  std::optional<ActivityFault> fault;
  if (work_->checker) {
    const bool good = work_->checker->result().good;
    outcome = work_->stopped ? Outcome::stopped : good ? Outcome::done : Outcome::failed;
  } else {
    std::tie(outcome, fault) = judge_work();
    record_place(knows_counts);
  }
  if (board_.error() && is_of_work(*board_.error())) board_.forgive();
  const Ticket ticket = work_->ticket;
  if (!board_.error()) move_to(MachineEvent::end);
  answer(ticket, outcome, std::move(fault));
  answer_holds(outcome == Outcome::failed ? Outcome::failed : Outcome::done);
}

std::pair<Outcome, std::optional<ActivityFault>> BoardMachineSession::judge_work() const {
  if (const auto error = board_.error()) {
    const Sentence trouble = sentence_of(*error);
    return {Outcome::failed, ActivityFault{fault_of(*error), {{"trouble", trouble.text}}, trouble}};
  }
  if (work_->findings->any_error()) {
    return {Outcome::failed, ActivityFault{MachineFault::program_wrong}};
  }
  if (work_->drive->stopped_by_probe()) {
    return {Outcome::failed, ActivityFault{MachineFault::probe_guard}};
  }
  if (work_->drive->stopped()) return {Outcome::stopped, {}};
  auto fault = work_->activity->fault();
  return {fault ? Outcome::failed : Outcome::done, std::move(fault)};
}

// Takes over the place at rest. If the board was lost, the place is not known until the board answers again.
void BoardMachineSession::record_place(bool knows_counts) {
  if (board_.error() && !is_of_work(*board_.error())) return;
  place_.rest_at(work_->drive->place(), work_->drive->downs());
  const bool agrees = !knows_counts || place_.agrees_with(watched_status());
  if (!agrees) publish({.kind = MachineChange::Kind::position_lost});
  const bool is_homed = work_->homing != nullptr && work_->homing->done() && !work_->drive->stopped();
  // The second motor of an axis has turned alone: of the first one the counts know nothing more.
  if (work_->homing != nullptr && board_.forget_shifts() && !is_homed) place_.doubt();
  // The path is done when the last pull-off has been planned: it may have been stopped since.
  if (agrees && is_homed) place_.home(work_->homing->homed(), watched_status());
}

// The drive brakes and switches the outputs off before it fails the link, so the line is noted now.
void BoardMachineSession::on_standstill() {
  if (!board_.standstill() || board_.error()) return;
  if (!busy()) return board_.fail(LinkError::stood_still);
  if (!work_->is_program() || work_->checker || work_->standstill_line) return;
  work_->standstill_line = work_->ahead.line_at(clock_of(*work_)).source.line;
}

// An error of the board ends what is going on. The machine is then in alarm or in fault until a reset.
void BoardMachineSession::check_board() {
  on_standstill();
  if (!board_.error() || state_ == MachineState::alarm || state_ == MachineState::fault) return;
  const LinkError error = *board_.error();
  if (busy() && is_of_work(error)) return;  // the drive ends by itself
  trouble_ = {.error = error, .sentence = sentence_of(error)};
  if (busy()) end_work();
  place_.doubt();
  place_.forget_board();
  const bool lost = error != LinkError::stopped && error != LinkError::drivers_off && error != LinkError::stood_still;
  move_to(lost ? MachineEvent::lose_board : MachineEvent::stop_at_once);
}

void BoardMachineSession::poll_panel() {
  if (!options_.over_a_line || board_.error() || !board_.ready()) return;
  const bool finishing = busy() && work_->stage == Work::Stage::asks_counts;
  const bool runs = busy() && work_->drive && !finishing;
  if (!finishing) panel_->ask(runs && work_->drive->state() == MotionDrive::State::held);
  const Panel::Pressed pressed = panel_->take_pressed();
  if (state_ == MachineState::idle && panel_->door_is_open()) {
    move_to(MachineEvent::open_door);
  } else if (state_ == MachineState::door && !busy() && !panel_->door_is_open()) {
    move_to(MachineEvent::close_door);
  }
  if (!runs) return;
  if (!work_->is_program()) {
    if (pressed.hold || pressed.door) work_->drive->stop();
    return;
  }
  if (pressed.hold) work_->drive->hold(HoldReason::operator_hold);
  if (pressed.door) work_->drive->hold(HoldReason::door);
  if (pressed.start && !refuse_spindle()) {
    work_->drive->resume(HoldReason::operator_hold);
    work_->drive->resume(HoldReason::door);
    work_->drive->resume(HoldReason::line_end);
  }
  update_holds();
}

void BoardMachineSession::move_to(MachineEvent event) {
  const std::optional<MachineState> next = next_state(state_, event);
  assert(next);
  if (!next) return;
  state_ = *next;
  publish({.kind = MachineChange::Kind::state, .state = state_});
}

void BoardMachineSession::publish(MachineChange change) {
  change.time = now();
  ++version_;
  if (changes_.size() == most_changes) changes_.pop_front();
  changes_.push_back(std::move(change));
}

void BoardMachineSession::answer(Ticket ticket, Outcome outcome, std::optional<ActivityFault> fault) {
  publish({.kind = MachineChange::Kind::answered, .ticket = ticket, .outcome = outcome, .fault = std::move(fault)});
}

void BoardMachineSession::answer_holds(Outcome outcome) {
  for (const Ticket ticket : std::exchange(waiting_holds_, {})) answer(ticket, outcome);
}

std::vector<MachineChange> BoardMachineSession::take_changes() {
  std::vector<MachineChange> taken(changes_.begin(), changes_.end());
  changes_.clear();
  return taken;
}

bool BoardMachineSession::busy() const {
  return work_ && work_->stage != Work::Stage::ended;
}

// A board that is greeted anew is waited for: the time of an emulated one passes only meanwhile.
bool BoardMachineSession::works() const {
  const bool is_greeted = !board_.ready() && !board_.error();
  return busy() || state_ == MachineState::offline || is_greeted || board_.awaits_handwheel();
}

MachineStatus BoardMachineSession::status() const {
  MachineStatus status;
  status.version = version_;
  status.time = now();
  status.state = state_;
  status.position = position();
  status.lost_place = lost_place().has_value();
  status.now_at = live_position_.at();
  status.speed_now = live_position_.speed();
  status.ahead = position().place;
  status.inputs = board_.inputs();
  status.overrides = overrides_;
  status.stops = stops_;
  status.trouble = trouble_.error;
  status.trouble_sentence = trouble_.sentence;
  if (options_.spindle != nullptr) {
    const HostSpindleStatus spindle = options_.spindle->status();
    status.version += spindle.version;
    if (trouble_.sentence.text.empty()) status.trouble_sentence = spindle.fault;
  }
  if (!busy() || !work_->drive) return status;
  const MotionDrive& drive = *work_->drive;
  status.holds = drive.holds();
  status.rests = drive.state() == MotionDrive::State::held || drive.state() == MotionDrive::State::ended;
  status.ahead = work_->ahead.place();
  status.activity = work_->activity->kind();
  status.progress = work_->ahead.progress_at(clock_of(*work_), work_->path->time());
  if (!status.progress) status.progress = work_->activity->progress();
  status.committed = drive.committed();
  status.outputs = drive.outputs();
  const PlannedLine& line = work_->ahead.line_at(clock_of(*work_));
  status.executes = line.source;
  if (work_->program != nullptr) {
    status.measured_tool = work_->program->measured_tool();
    if (line.source.line != 0) status.executes.work_zero = line.work_zero;
  }
  if (const auto& wait = drive.waits_for()) {
    status.waits_for = OperatorWait{.kind = wait->kind,
                                    .tool = wait->tool,
                                    .line = wait->source.line,
                                    .number = work_->stops_before + drive.stops(),
                                    .words = work_->words_at(wait->source.line)};
  }
  if (work_->homing != nullptr && !work_->homing->done()) {
    status.homing = work_->homing->stage();
    status.homing_axis = work_->homing->axis()->axis;
  }
  return status;
}

const MotionDrive* BoardMachineSession::drive() const {
  return work_ ? work_->drive.get() : nullptr;
}
const Program* BoardMachineSession::program() const {
  return work_ ? work_->program : nullptr;
}
std::optional<MachineSession::ProgramResults> BoardMachineSession::program_results() const {
  if (program() == nullptr) return {};
  return ProgramResults{.parameters = program()->saved_parameters(), .tools = program()->tools()};
}
const HomingPath* BoardMachineSession::homing() const {
  return work_ ? work_->homing : nullptr;
}
const QueueUpdateLedger* BoardMachineSession::ledger() const {
  return work_ && work_->drive ? work_->drive->ledger() : nullptr;
}

}  // namespace passo
