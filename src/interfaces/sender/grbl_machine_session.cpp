#include "passo/sender/grbl_machine_session.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "grbl_board_storage.hpp"
#include "grbl_work.hpp"
#include <fmt/format.h>

#include "passo/geometry/euclid.hpp"
#include "passo/interpreter/saved_offsets.hpp"
#include "passo/sender/grbl_code.hpp"
#include "passo/wire/message.hpp"

namespace passo {
namespace {

constexpr std::size_t most_kept_changes = 4096;
constexpr std::uint64_t items_of_a_turn = 2000;
// How long a lost connection is looked for before it is a fault.
constexpr Seconds longest_reopening{10};
constexpr Seconds between_looks_for_device{0.5};
constexpr double same_report = 2e-3;  // mm: reports have three decimals

// Inputs as bits of BoardInput: a board reports letters.
std::uint16_t inputs_of(std::string_view pins) {
  unsigned inputs = 0;
  for (const char letter : pins) {
    switch (letter) {
      case 'P': inputs |= input_probe; break;
      case 'D': inputs |= input_door; break;
      case 'H': inputs |= input_hold; break;
      case 'S': inputs |= input_start; break;
      case 'E': inputs |= input_emergency_stop; break;
      default: {
        const auto axis = axis_of(letter);
        if (axis && index_of(*axis) < max_motors) inputs |= unsigned{input_limit} << index_of(*axis);
      }
    }
  }
  return static_cast<std::uint16_t>(inputs);
}

std::optional<Point> contact_of(std::string_view value, const GrblMachine& board, bool& touched) {
  const std::size_t colon = value.rfind(':');
  if (colon == std::string_view::npos) return {};
  touched = value.substr(colon + 1) == "1";
  const auto place = read_grbl_place(value.substr(0, colon), board.axes);
  return place ? std::optional(board.millimetres(*place)) : std::nullopt;
}

}  // namespace

GrblMachineSession::Loan::Loan(GrblMachineSession& session)
    : storage(std::make_unique<GrblBoardStorage>(session)), settings(session) {}

GrblMachineSession::GrblMachineSession(const MachineDescription& machine, GrblPort& port, Seconds ahead)
    : machine_(machine), port_(port), sender_(port.now()) {
  connection_.ahead = ahead;
  connect_again(false);
}

GrblMachineSession::~GrblMachineSession() = default;

void GrblMachineSession::connect_again(bool on_open_line) {
  sender_ = on_open_line ? GrblSender::on_open_line(now()) : GrblSender(now());
  sender_.listen([this](std::string_view line) { hear(line); });
  connection_.is_prepared = false;
  loan_.lent = false;
  connection_.asks_offsets = false;
  heard_.reports = 0;
  heard_.outputs.reset();
  heard_.outputs_after = 0;
  if (work_) work_->progress.outputs_line = 0;
}

bool GrblMachineSession::busy() const {
  return work_ && work_->stage != Work::Stage::ended;
}

bool GrblMachineSession::works() const {
  return busy() || state_ == MachineState::offline || to_store_.has_value() || loan_.lent || !sender_.all_answered() ||
         connection_.asks_offsets;
}

// All lines are answered, and the board has reported since that it is idle.
bool GrblMachineSession::rests() const {
  return sender_.at_rest();
}

// By its hold input, or by another sender.
bool GrblMachineSession::is_held_at_board() const {
  return sender_.report() && sender_.report()->state == "Hold";
}

// As the board reports them: the operator, or somebody at the board, may have switched them.
OutputState GrblMachineSession::outputs_now() const {
  const OutputState ordered = work_ && work_->feed ? work_->feed->outputs() : OutputState();
  const std::uint64_t change = work_ ? work_->progress.outputs_line : 0;
  const bool is_not_reported_yet = heard_.outputs_after < change && sender_.lines_answered() >= change;
  if (is_not_reported_yet) return ordered;
  if (!heard_.outputs) return busy() ? ordered : OutputState();
  const auto is_on = [&](char letter) { return heard_.outputs->find(letter) != std::string::npos; };
  OutputState outputs;
  if (is_on('S')) outputs.spindle = SpindleDirection::clockwise;
  if (is_on('C')) outputs.spindle = SpindleDirection::counterclockwise;
  const bool turns = outputs.spindle != SpindleDirection::off;
  const bool is_ordered = outputs.spindle == ordered.spindle;
  if (turns) outputs.revolutions_per_minute = is_ordered ? ordered.revolutions_per_minute : heard_.speed;
  outputs.mist = is_on('M');
  outputs.flood = is_on('F');
  return outputs;
}

void GrblMachineSession::exchange(Seconds most) {
  if (loan_.storage->uploads()) {
    loan_.storage->exchange(port_, std::min(most, between_looks));
    if (port_.is_broken()) sender_.lose();
    return;
  }
  const std::string bytes = sender_.take_bytes(now());
  if (!bytes.empty()) port_.send(bytes);
  const std::string came = port_.receive(std::isfinite(most.value()) ? most : between_looks);
  if (port_.is_broken()) return sender_.lose();
  sender_.receive(came, now());
  // Answers to what was just received go out at once.
  const std::string more = sender_.take_bytes(now());
  if (!more.empty()) port_.send(more);
}

void GrblMachineSession::poll(Seconds most) {
  if (connection_.broken_since) {
    if (port_.open_again()) {
      connection_.broken_since.reset();
      connect_again(false);
    } else if (now() - *connection_.broken_since > longest_reopening) {
      connection_.broken_since.reset();
      return break_off(MachineEvent::lose_board, {.code = "grbl.line-lost", .message = "the connection is not there"});
    } else {
      static_cast<void>(port_.receive(std::min(most, between_looks)));
      return;
    }
  }
  if (state_ == MachineState::fault) {
    static_cast<void>(port_.receive(std::isfinite(most.value()) ? most : between_looks));
    return look_for_device();
  }
  exchange(busy() ? std::min(most, between_looks) : most);
  hear_report();
  check_fault();
  if (state_ == MachineState::offline) return go_online();
  if (state_ == MachineState::check) return poll_check();
  if (busy()) return poll_work();
  poll_idle();
  loan_.storage->poll();
}

// A device that was unplugged is opened when it has returned. What it was doing is not continued, and its place stays
// lost until somebody homes it or vouches for it.
void GrblMachineSession::look_for_device() {
  if (!port_.is_broken() || now() < recovery_.next_look) return;
  recovery_.next_look = now() + between_looks_for_device;
  if (!port_.has_returned() || !port_.open_again()) return;
  trouble_ = {};
  connect_again(false);
  move_to(MachineEvent::reset);
}

void GrblMachineSession::hear(std::string_view line) {
  hear_board_file(line);
  constexpr std::string_view probe = "[PRB:";
  if (!line.starts_with(probe) || !line.ends_with(']')) return;
  line.remove_prefix(probe.size());
  line.remove_suffix(1);
  heard_.contact.at = contact_of(line, sender_.machine(), heard_.contact.touched);
}

void GrblMachineSession::hear_report() {
  if (sender_.reports_heard() == heard_.reports || !sender_.report()) return;
  heard_.reports = sender_.reports_heard();
  const GrblReport& report = *sender_.report();
  if (heard_.pins != report.pins) ++news_.version;
  heard_.pins = report.pins;
  hear_switches(report);
  const auto place = sender_.place();
  if (!place) return;
  live_.hear(*place, now());
  if (report.work_offset) hear_work_zero(sender_.machine().millimetres(*report.work_offset));
  if (report.rests() && !busy()) {
    if (position_.place != *place) ++news_.version;
    position_.place = *place;
    live_.rest_at(*place);
  }
  if (!busy() || !work_->feed || work_->stage == Work::Stage::resyncs) return;
  const std::size_t blocks = board_.blocks + 1;
  work_->progress.executed.hear(sender_.lines_answered(), blocks, *place);
}

// Overrides and outputs. Somebody may have changed them at the board.
void GrblMachineSession::hear_switches(const GrblReport& report) {
  if (const auto& told = sender_.told_overrides()) {
    const Overrides before = overrides_;
    overrides_.feed = told->feed / 100.0;
    overrides_.spindle = told->spindle / 100.0;
    overrides_.rapids = told->rapids / 100.0;
    if (overrides_ != before) ++news_.version;
  }
  if (report.speed) heard_.speed = *report.speed / std::max(overrides_.spindle, 0.01);
  if (!report.outputs) return;
  if (heard_.outputs != report.outputs) ++news_.version;
  heard_.outputs = report.outputs;
  heard_.outputs_after = sender_.lines_answered();
}

// Somebody may have set a zero at the machine.
void GrblMachineSession::hear_work_zero(const Point& zero) {
  const auto before = std::exchange(heard_.work_zero, zero);
  if (before && distance(*before, zero) > same_report) connection_.offsets_are_old = true;
}

void GrblMachineSession::ask_for_offsets() {
  sender_.ask_for_offsets();
  connection_.offsets_are_old = false;
  connection_.asks_offsets = true;
}

// All that the board has told of itself.
void GrblMachineSession::take_board() {
  connection_.asks_offsets = false;
  const bool are_other_offsets = board_.offsets != sender_.machine().offsets;
  board_ = sender_.machine();
  match_ = match_with_board(machine_, board_);
  if (!are_other_offsets) return;
  ++news_.version;
  if (connection_.offsets_listener && !to_store_) connection_.offsets_listener();
}

// Sets the modes that the lines need, and reads the offsets.
void GrblMachineSession::prepare() {
  for (const char* line : {GrblCode::known_modes, "M5", "M9"}) sender_.add(line);
  sender_.ask_for_offsets();
  connection_.is_prepared = true;
}

void GrblMachineSession::go_online() {
  if (!sender_.ready()) return;
  locked_ = sender_.report()->state == "Alarm";
  if (!connection_.is_prepared && !locked_) return prepare();
  if (!(locked_ ? sender_.all_answered() : rests())) return;
  take_board();
  const auto place = sender_.place();
  if (!place) {
    return break_off(
        MachineEvent::lose_board,
        {.code = "grbl.no-place", .message = "the machine's status reports have no position; $10=1 adds it"});
  }
  position_.place = *place;
  live_.rest_at(*place);
  // A board that is locked at its start, or in an alarm, does not know where it is.
  if (locked_ || recovery_.lacks_place) {
    lose_place();
  } else if (position_.trust == Trust::unknown) {
    position_.trust = Trust::commanded;
    position_.is_lost = false;
  }
  overrides_ = {};
  move_to(MachineEvent::ready);
}

void GrblMachineSession::lose_place() {
  position_.trust = Trust::unknown;
  position_.is_lost = true;
  recovery_.homed = {};
}

// In an alarm that is over, e.g. after the start of a machine with switches.
void GrblMachineSession::unlock() {
  if (!std::exchange(locked_, false)) return;
  sender_.add("$X");
}

void GrblMachineSession::poll_idle() {
  const auto& report = sender_.report();
  if (!report) return;
  if (state_ == MachineState::idle && report->state == "Door") {
    move_to(MachineEvent::open_door);
  } else if (state_ == MachineState::door && report->state == "Idle") {
    move_to(MachineEvent::close_door);
  }
  if (loan_.lent || state_ != MachineState::idle) return;
  if (connection_.asks_offsets && sender_.all_answered()) take_board();
  if (locked_ || !rests()) return;
  if (connection_.offsets_are_old) return ask_for_offsets();
  if (!to_store_) return;
  const SavedParameters wanted = *std::exchange(to_store_, {});
  const SavedParameters present = offsets();
  bool is_changed = false;
  for (int system = 1; system <= work_systems; ++system) {
    if (!board_.offsets.contains(name_of_system(system))) continue;
    const Point now_there = saved_point(present, work_offset_parameter(system));
    const Point then = saved_point(wanted, work_offset_parameter(system));
    std::string words;
    for (const AxisDescription& axis : machine_.axes) {
      if (std::abs(then[axis.axis] - now_there[axis.axis]) < 5e-4) continue;
      words += fmt::format("{}{:.4f}", letter_of(axis.axis), then[axis.axis]);
    }
    if (words.empty()) continue;
    // A start line ($N0) may have set inches.
    sender_.add(fmt::format("G21G10L2P{}{}", system, words));
    is_changed = true;
  }
  if (is_changed) ask_for_offsets();
}

void GrblMachineSession::poll_check() {
  if (!work_->stopped && !work_->checker->go_on(items_of_a_turn)) return;
  const bool good = work_->checker->result().good;
  end_work(work_->stopped ? Outcome::stopped : good ? Outcome::done : Outcome::failed);
}

SavedParameters GrblMachineSession::offsets(const SavedParameters& kept) const {
  SavedParameters parameters = kept;
  const GrblMachine& board = board_;
  const auto set = [&](int first, const Point& offset) {
    for (const AxisDescription& axis : machine_.axes) {
      parameters[first + static_cast<int>(index_of(axis.axis))] = offset[axis.axis];
    }
  };
  for (int system = 1; system <= work_systems; ++system) {
    const auto found = board.offsets.find(name_of_system(system));
    if (found != board.offsets.end()) set(work_offset_parameter(system), found->second);
  }
  constexpr int first_home = 5161;
  constexpr int second_home = 5181;
  if (const auto home = board.offsets.find("G28"); home != board.offsets.end()) set(first_home, home->second);
  if (const auto home = board.offsets.find("G30"); home != board.offsets.end()) set(second_home, home->second);
  return parameters;
}

void GrblMachineSession::store_offsets(const SavedParameters& parameters) {
  to_store_ = parameters;
}

// A board in an alarm tells and takes settings, too.
GrblSender* GrblMachineSession::lend_sender() {
  if (loan_.lent || busy() || state_ != MachineState::idle || !sender_.all_answered()) return nullptr;
  while (sender_.take_reply()) continue;  // of an earlier reader that did not wait
  loan_.lent = true;
  return &sender_;
}

void GrblMachineSession::take_sender_back() {
  if (!std::exchange(loan_.lent, false)) return;
  board_ = sender_.machine();
  match_ = match_with_board(machine_, board_);
  ++news_.version;
}

void GrblMachineSession::take_sender_back_and_greet() {
  if (loan_.lent) connect_again(true);
}

BoardStorage* GrblMachineSession::storage() {
  return BoardFiles::of(board_) ? loan_.storage.get() : nullptr;
}

std::optional<Refusal> GrblMachineSession::lost_place() const {
  if (position_.trust != Trust::unknown || state_ == MachineState::offline) return {};
  const bool homes = abilities().can(Ability::home);
  return Refusal{homes ? RefusalReason::unknown_so_home : RefusalReason::unknown_so_jog};
}

std::uint64_t GrblMachineSession::lines_of_program() const {
  return work_ ? sender_.lines_sent() - std::min(sender_.lines_sent(), work_->progress.lines_before) : 0;
}

std::optional<MachineSession::ProgramResults> GrblMachineSession::program_results() const {
  if (!work_ || !work_->program) return {};
  return ProgramResults{.parameters = work_->program->saved_parameters(), .tools = work_->program->tools()};
}

// As the board reports it. From two positions it would be inexact, because a report is late by an unknown time.
MmPerSecond GrblMachineSession::speed_now() const {
  if (state_ == MachineState::alarm || state_ == MachineState::fault) return MmPerSecond(0);
  const auto& report = sender_.report();
  if (!report || !report->feed) return live_.speed();
  return MmPerSecond(*report->feed * (sender_.machine().in_inches() ? mm_per_inch : 1) / seconds_per_minute);
}

MachineStatus GrblMachineSession::status() const {
  MachineStatus status;
  status.version = news_.version;
  status.time = now();
  status.state = state_;
  status.position = position_;
  status.lost_place = lost_place().has_value();
  status.now_at = live_.at();
  status.speed_now = speed_now();
  status.ahead = position_.place;
  status.inputs = inputs_of(heard_.pins);
  status.overrides = overrides_;
  status.outputs = outputs_now();
  status.stops = stops_;
  status.trouble_sentence = trouble_.words;
  if (trouble_.words.text.empty() && match_.warning) status.trouble_sentence = *match_.warning;
  if (!busy() && is_held_at_board()) status.holds.add(HoldReason::operator_hold);
  if (!busy() || work_->checker) return status;
  const Work& work = *work_;
  const auto& report = sender_.report();
  const bool waits = work.feed && work.feed->asks() != GrblFeed::Asks::nothing && rests();
  const bool is_held = work.stage == Work::Stage::prepares && is_held_at_board();
  status.rests = waits || (report && report->rests() && (work.stage == Work::Stage::moves || is_held));
  status.ahead = live_.at();
  status.activity = work.kind;
  status.holds.set(HoldReason::operator_hold, work.hold.asked || (state_ == MachineState::hold && work.hold.heard));
  status.holds.set(HoldReason::door, state_ == MachineState::door);
  if (work.feed) {
    status.executes = work.progress.executed.source();
    status.executes.to = work.progress.executed.last_line();
    if (work.program) {
      status.measured_tool = work.program->measured_tool();
      if (status.executes.line != 0) status.executes.work_zero = work.progress.executed.work_zero();
    }
    if (work.start && work.start->nominal_time > Seconds(0)) {
      status.progress = std::min(1.0, work.progress.reached / work.start->nominal_time);
    }
    if (waits && work.feed->asks() == GrblFeed::Asks::operator_stop) {
      const Action& stop = work.feed->stop();
      status.waits_for = OperatorWait{.kind = stop.kind,
                                      .tool = stop.tool,
                                      .line = stop.source.line,
                                      .number = work.progress.stops,
                                      .words = work_->words_at(stop.source.line)};
      const bool is_tool = stop.kind == Action::Kind::tool_change;
      status.holds.add(is_tool ? HoldReason::tool_change : HoldReason::program_stop);
    }
    if (waits && work.feed->asks() == GrblFeed::Asks::line) status.holds.add(HoldReason::await_line);
  }
  if (work.is_board_file()) tell_board_file(status);
  return status;
}

void GrblMachineSession::move_to(MachineEvent event) {
  const std::optional<MachineState> next = next_state(state_, event);
  assert(next);
  if (!next) return;
  state_ = *next;
  publish({.kind = MachineChange::Kind::state, .state = state_});
}

void GrblMachineSession::publish(MachineChange change) {
  change.time = now();
  ++news_.version;
  if (news_.changes.size() == most_kept_changes) news_.changes.pop_front();
  news_.changes.push_back(std::move(change));
}

void GrblMachineSession::answer(Ticket ticket, Outcome outcome, std::optional<ActivityFault> fault) {
  publish({.kind = MachineChange::Kind::answered, .ticket = ticket, .outcome = outcome, .fault = std::move(fault)});
}

void GrblMachineSession::answer_holds(Outcome outcome) {
  for (const Ticket ticket : std::exchange(tickets_.holds, {})) answer(ticket, outcome);
}

std::vector<MachineChange> GrblMachineSession::take_changes() {
  std::vector<MachineChange> taken(news_.changes.begin(), news_.changes.end());
  news_.changes.clear();
  return taken;
}

}  // namespace passo
