// BoardMachineSession: how the session answers each request.
#include <algorithm>
#include <string>
#include <utility>

#include "panel.hpp"
#include "work.hpp"

#include "passo/activity/jog_line.hpp"
#include "passo/activity/probe_line.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/interpreter/tool_change_plan.hpp"
#include "passo/session/request_checks.hpp"

namespace passo {
namespace {

// The axes whose switch may be the closed one: "X or Y". Empty: no axis has a switch on that input.
std::string axes_with_switch(const MachineDescription& machine, unsigned input) {
  std::string axes;
  for (const AxisDescription& axis : machine.axes) {
    if (!axis.home || (axis.home_switches() >> input & 1U) == 0) continue;
    axes += (axes.empty() ? "" : " or ") + std::string{letter_of(axis.axis)};
  }
  return axes;
}

Failure<Refusal> refusal(RefusalReason reason) {
  return Failure{Refusal{reason}};
}

}  // namespace

Result<Ticket, Refusal> BoardMachineSession::request(Request wanted) {
  return std::visit([this](auto& one) { return handle(one); }, wanted);
}

// Why an event may not happen now. Empty: the table allows the event.
std::optional<Refusal> BoardMachineSession::refuse(MachineEvent event) const {
  if (next_state(state_, event)) return {};
  return why_not();
}

Refusal BoardMachineSession::why_not() const {
  return state_ == MachineState::alarm ? refusal_in_alarm() : refusal_in(state_, busy());
}

std::optional<Refusal> BoardMachineSession::closed_limit() const {
  const unsigned closed = board_.inputs() & ~unsigned{options_.greeting.setup.alarms};
  for (unsigned input = 0; input < max_motors; ++input) {
    if ((closed & (unsigned{input_limit} << input)) == 0) continue;
    std::string axes = axes_with_switch(machine_, input);
    if (axes.empty()) return Refusal{RefusalReason::switch_closed, {{"number", std::to_string(input + 1)}}};
    return Refusal{RefusalReason::switch_of_axes_closed, {{"axes", std::move(axes)}}};
  }
  return {};
}

// A way off a closed switch is free, and so is a way of axes that have other switches. Of a switch that no axis is
// homed by, nobody knows at which end it is.
std::optional<Refusal> BoardMachineSession::refuse_way(const Point& way) const {
  for (const AxisDescription& axis : machine_.axes) {
    const double part = way[axis.axis];
    if (!axis.home || part == 0 || (board_.inputs() & axis.home_switches()) == 0) continue;
    if ((part > 0) != axis.home->toward_high) continue;
    return Refusal{RefusalReason::switch_closed_there, {{"axis", std::string(1, letter_of(axis.axis))}}};
  }
  return {};
}

BoardMachineSession::Answer BoardMachineSession::at_once() {
  const Ticket ticket = ++last_ticket_;
  answer(ticket, Outcome::done);
  return ticket;
}

BoardMachineSession::Answer BoardMachineSession::begin(MachineEvent event, std::unique_ptr<Work> work) {
  work_ = std::move(work);
  work_->ticket = ++last_ticket_;
  move_to(event);
  return work_->ticket;
}

StepOptions BoardMachineSession::step_options() const {
  StepOptions options = passo::step_options(machine_);
  options.start = position().place;
  options.place = place_.on_board();
  options.downs = position().downs;
  return options;
}

DriveOptions BoardMachineSession::drive_options() const {
  DriveOptions options{.live = live_commitment,
                       .not_before = enabled_at_ + machine_.pins.enable_wait,
                       .spindle_wait = machine_.silence.spindle_wait,
                       .spindle_run_up = machine_.spindle.run_up,
                       .waits_at_optional = stops_.optional_stop,
                       .kept_in_stops = kept_in_stops(machine_),
                       .spindle = options_.spindle};
  if (machine_.tool_change) options.coolant_wait = collet_wait(*machine_.tool_change);
  if (options_.over_a_line) options.tails.emplace();
  return options;
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Start& start) {
  if (auto refused = refuse(MachineEvent::begin_run)) return Failure{*refused};
  if (auto refused = closed_limit()) return Failure{*refused};
  // A journal knows where its job was broken off.
  if (auto refused = lost_place(); refused && !start.from) return Failure{*refused};
  if (auto refused = refuse_spindle()) return Failure{*refused};
  auto work = std::make_unique<Work>();
  if (start.from && start.lead_in.empty()) start.stands = start.from->point;
  const bool is_on_path = start.from && start.stands;
  if (is_on_path) stand_at({.place = *start.stands, .trust = position().trust, .downs = start.from->downs});
  if (start.findings != nullptr) work->findings = start.findings;
  const int counts = machine_.spindle.counts_per_turn;
  // Over a line, a tap does not follow the spindle while it reverses: the tool rests meanwhile, and a floating holder
  // makes up the difference. Under a limit of jerk, a change of speed must be complete before the next one, which is
  // too slow to follow a reversing spindle.
  work->answers = StoredResults(
      {.probes = start.answers_probes, .taps = !options_.over_a_line && counts > 0 && !has_jerk_limit(machine_)});
  InterpreterOptions interpretation = start.options;
  if (!start.from) interpretation.start = position().place;
  auto program = std::make_unique<Program>(std::move(start.program), machine_, interpretation, work->answers,
                                           *work->findings, start.nominal_time, std::move(start.known_probes));
  work->program = program.get();
  work->activity = std::move(program);
  DriveOptions options = drive_options();
  options.counts_per_turn = counts;
  options.guards_by_probe = machine_.probe.guards && start.answers_probes;
  options.waits_for_operator = start.waits_for_operator;
  options.stops_at_lines = start.live && stops_.single_block;
  options.may_stop_at_lines = start.live;
  if (!start.live && !options.guards_by_probe) options.live = endless_commitment;
  if (start.from) {
    options.begin_at = start.from->place;
    options.switches = static_cast<std::uint8_t>(start.from->switches & options.kept_in_stops);
    work->stops_before = start.from->stops;
  }
  options.lead_in = std::move(start.lead_in);
  Watchers& watchers = start.watchers;
  if (!options.lead_in.empty() && watchers.rests) {
    watchers.rests = [from = *start.from, lead_in = options.lead_in.size(),
                      tell = watchers.rests](const BoardStop& rest) { tell(without_lead_in(from, lead_in, rest)); };
  }
  put_on_drive(*work, options, watchers, start.live, start.live ? start.nominal_time : Seconds(0));
  if (is_on_path && work->drive->ledger() != nullptr) {
    work->drive->switch_on(start.from->outputs, start.from->spindle_wait);
  }
  return begin(MachineEvent::begin_run, std::move(work));
}

// The program outlives the stream, and so do its modes. So what the program has left on is switched on again.
BoardMachineSession::Answer BoardMachineSession::handle(request::Stream& stream) {
  if (auto refused = refuse(MachineEvent::begin_run)) return Failure{*refused};
  if (auto refused = closed_limit(); refused && !stream.program->jogs()) return Failure{*refused};
  if (auto refused = lost_place(); refused && !stream.program->jogs()) return Failure{*refused};
  if (auto refused = refuse_spindle(); refused && !stream.program->jogs()) return Failure{*refused};
  auto work = std::make_unique<Work>();
  work->lines = stream.program;
  work->activity = std::make_unique<StreamedProgramRun>(*stream.program, machine_);
  DriveOptions options = drive_options();
  options.waits_for_operator = true;
  put_on_drive(*work, options, stream.watchers);
  return begin(MachineEvent::begin_run, std::move(work));
}

// Asked again before the machine rests, it brakes no second time: it would never get to where the lines go on.
BoardMachineSession::Answer BoardMachineSession::handle(request::DropLines&) {
  if (!busy() || work_->lines == nullptr) return refusal(RefusalReason::no_lines_queued);
  const Ticket ticket = ++last_ticket_;
  waiting_holds_.push_back(ticket);
  work_->lines->drop(position().place);
  if (!std::exchange(work_->drops, true)) work_->drive->drop();
  return ticket;
}

Seconds BoardMachineSession::clock_of(const Work& work) const {
  const QueueUpdateLedger* const ledger = work.drive->ledger();
  return ledger != nullptr ? ledger->executed_time() : now();
}

// Puts the work's activity on a drive, and connects all watchers.
void BoardMachineSession::put_on_drive(Work& work, const DriveOptions& options, const Watchers& watchers,
                                       bool knows_ahead, Seconds nominal_time) {
  StoredResults& answers = work.lines != nullptr ? work.lines->answers() : work.answers;
  const MotionLimits limits = motion_limits(machine_);
  work.path = std::make_unique<SkippedTime>(*work.activity, limits, options.begin_at.value_or(PathPosition()));
  work.ahead.begin(position().place, options.lead_in, limits, nominal_time);
  work.drive = std::make_unique<MotionDrive>(*work.path, limits, step_options(), board_, answers, options);
  MotionDrive& drive = *work.drive;
  if (knows_ahead) {
    drive.motion().watch([this, &work, limits](const MotionItem& item) {
      const auto* move = std::get_if<PlannedMove>(&item);
      const auto* action = std::get_if<Action>(&item);
      const Seconds time = move != nullptr ? move->duration() : action->dwell;
      const QueueUpdateLedger* const ledger = work.drive->ledger();
      const Seconds ends = ledger != nullptr ? ledger->given_time() : now() + work.drive->committed();
      if (move != nullptr) work.ahead.plan(*move, limits, ends - time, ends, clock_of(work));
      if (action != nullptr) work.ahead.plan(*action, ends - time, ends, clock_of(work));
    });
  }
  if (work.program != nullptr && watchers.operations) work.program->operations().watch(watchers.operations);
  if (work.program != nullptr && watchers.path) work.program->path().watch(watchers.path);
  if (watchers.planned) drive.motion().watch(watchers.planned);
  if (watchers.motion && drive.ledger() == nullptr) drive.motion().watch(watchers.motion);
  if (watchers.items) drive.items().watch(watchers.items);
  drive.probe().watch([this, watcher = watchers.probe](const ProbeOutcome& outcome) {
    if (watcher) watcher(outcome);
    publish({.kind = MachineChange::Kind::probed, .probe = outcome});
  });
  if (QueueUpdateLedger* const ledger = drive.ledger()) {
    if (watchers.motion) ledger->watch_motion(watchers.motion);
    if (watchers.executed) ledger->watch_executed(watchers.executed);
    if (watchers.rests) ledger->watch_rests(watchers.rests);
    if (HostSpindle* const spindle = options_.spindle; spindle != nullptr && work.is_program()) {
      ledger->watch_executed([spindle](const LinkItem& item) {
        if (const auto* outputs = std::get_if<BoardOutputs>(&item)) spindle->order(SpindleOrder::of(*outputs));
      });
    }
  }
  if (work.is_program() && overrides_ != Overrides()) put_overrides_on(drive);
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Jog& jog) {
  if (auto refused = refuse(MachineEvent::begin_jog)) return Failure{*refused};
  if (auto refused = refusal_of(jog)) return Failure{*refused};
  if (auto refused = refuse_way(jog.way.direction)) return Failure{*refused};
  auto work = std::make_unique<Work>();
  work->activity = std::make_unique<JogLine>(machine_, position().place, jog.way, position().trust != Trust::unknown);
  work->lease.begin(jog.lease, now());
  put_on_drive(*work, drive_options());
  work->drive->set_feed_override(jog.share);
  return begin(MachineEvent::begin_jog, std::move(work));
}

// Has no effect on a jog that has begun to brake.
BoardMachineSession::Answer BoardMachineSession::handle(request::RenewKeepAlive& renew) {
  if (state_ != MachineState::jog) return refusal(RefusalReason::no_jog);
  if (auto refused = refusal_of(renew)) return Failure{*refused};
  if (renew.share) work_->drive->set_feed_override(*renew.share);
  work_->lease.renew(now());
  return at_once();
}

MachineAbilities BoardMachineSession::abilities() const {
  MachineAbilities abilities;
  abilities.lack(Ability::home_axis,
                 {.code = "ability.grbl.home-axis", .text = "this board homes all its axes together"});
  abilities.lack(Ability::board_files, {.code = "ability.board-files", .text = "this board stores no files"});
  return abilities;
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Home& home) {
  if (auto refused = refuse(MachineEvent::begin_home)) return Failure{*refused};
  if (home.axis) return Failure{refusal_of(abilities(), Ability::home_axis)};
  if (machine_.homing.empty()) {
    return refusal(RefusalReason::no_switches);
  }
  auto work = std::make_unique<Work>();
  auto path = std::make_unique<HomingPath>(machine_, work->answers, position().place);
  work->homing = path.get();
  work->activity = std::move(path);
  DriveOptions options = drive_options();
  options.live = endless_commitment;
  put_on_drive(*work, options);
  return begin(MachineEvent::begin_home, std::move(work));
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Probe& probe) {
  if (auto refused = refuse(MachineEvent::begin_probe)) return Failure{*refused};
  if (auto refused = refusal_of(probe, machine_, position(), Mm(0))) return Failure{*refused};
  if (auto refused = refuse_way(probe.target - position().place)) return Failure{*refused};
  auto work = std::make_unique<Work>();
  work->activity =
      std::make_unique<ProbeLine>(position().place, probe.target, probe.speed, probe.toward, work->answers);
  put_on_drive(*work, drive_options());
  return begin(MachineEvent::begin_probe, std::move(work));
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Check& check) {
  if (auto refused = refuse(MachineEvent::begin_check)) return Failure{*refused};
  auto work = std::make_unique<Work>();
  if (check.findings != nullptr) work->findings = check.findings;
  check.options.start = position().place;
  work->checker = std::make_unique<ProgramChecker>(std::move(check.program), machine_, check.options, *work->findings);
  return begin(MachineEvent::begin_check, std::move(work));
}

// A hold ends an activity that is not a program.
BoardMachineSession::Answer BoardMachineSession::handle(request::RunBoardFile&) {
  return Failure{refusal_of(abilities(), Ability::board_files)};
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Hold& hold) {
  if (!busy() || state_ == MachineState::check) return refusal(RefusalReason::nothing_moves);
  const Ticket ticket = ++last_ticket_;
  if (!work_->is_program()) {
    work_->drive->stop();
  } else {
    work_->drive->hold(hold.for_door ? HoldReason::door : HoldReason::operator_hold);
    work_->rest.hold(hold.for_door);
  }
  waiting_holds_.push_back(ticket);
  update_holds();
  return ticket;
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Resume&) {
  if (!busy() || !work_->is_program()) return refusal(RefusalReason::no_program_held);
  MotionDrive& drive = *work_->drive;
  const HoldReasons holds = drive.holds();
  if (drive.stopped() || !holds.any_of({HoldReason::operator_hold, HoldReason::door, HoldReason::line_end})) {
    return refusal(RefusalReason::no_program_held);
  }
  if (panel_->door_is_open()) return refusal(RefusalReason::door_open);
  if (auto refused = refuse_spindle()) return Failure{*refused};
  work_->rest.resume();
  drive.resume(HoldReason::operator_hold);
  drive.resume(HoldReason::door);
  drive.resume(HoldReason::line_end);
  answer_holds(Outcome::stopped);  // those that were called off before the machine came to rest
  update_holds();
  return at_once();
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Stop&) {
  if (!busy()) return refusal(RefusalReason::nothing_going_on);
  const Ticket ticket = waiting_holds_.emplace_back(++last_ticket_);
  work_->stopped = true;
  if (work_->drive) work_->drive->stop();
  return ticket;
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Override& change) {
  if (auto refused = refusal_of(change)) return Failure{*refused};
  overrides_.feed = change.feed.value_or(overrides_.feed);
  overrides_.adaptive_feed = change.adaptive_feed.value_or(overrides_.adaptive_feed);
  overrides_.spindle = change.spindle.value_or(overrides_.spindle);
  overrides_.rapids = change.rapids.value_or(overrides_.rapids);
  if (busy() && work_->is_program()) {
    MotionDrive& drive = *work_->drive;
    if (change.feed) drive.set_feed_override(*change.feed);
    if (change.adaptive_feed) drive.set_adaptive_feed(*change.adaptive_feed);
    if (change.spindle) drive.set_spindle_override(*change.spindle);
    if (change.rapids) drive.set_rapid_override(*change.rapids);
    update_holds();
  }
  ++version_;
  return at_once();
}

BoardMachineSession::Answer BoardMachineSession::handle(request::SwitchOutputs& wanted) {
  if (!busy() || !work_->is_program() || work_->stage != Work::Stage::moves || work_->drive->stopped()) {
    return refusal(RefusalReason::no_program_runs);
  }
  if (auto refused = refusal_of(wanted, machine_)) return Failure{*refused};
  MotionDrive& drive = *work_->drive;
  const bool held = drive.state() == MotionDrive::State::held && state_ == MachineState::hold;
  if (wanted.spindle_stands && !held) {
    return refusal(RefusalReason::spindle_turns);
  }
  if (wanted.mist) drive.switch_mist(*wanted.mist);
  if (wanted.flood) drive.switch_flood(*wanted.flood);
  if (wanted.spindle_stands) drive.stop_spindle(*wanted.spindle_stands);
  ++version_;
  return at_once();
}

// Of single block, a stream knows nothing: whoever sends its lines may wait between them.
BoardMachineSession::Answer BoardMachineSession::handle(request::ChooseStops& chosen) {
  stops_.single_block = chosen.single_block.value_or(stops_.single_block);
  stops_.optional_stop = chosen.optional_stop.value_or(stops_.optional_stop);
  if (busy() && work_->is_program()) {
    work_->drive->wait_at_optional(stops_.optional_stop);
    if (work_->program != nullptr) work_->drive->stop_at_lines(stops_.single_block);
    update_holds();
  }
  ++version_;
  return at_once();
}

BoardMachineSession::Answer BoardMachineSession::handle(request::OperatorDone&) {
  if (!busy() || !work_->drive || !work_->drive->waits_for()) {
    return refusal(RefusalReason::not_waiting);
  }
  if (OperatorMessages* const words = work_->operator_messages()) words->pass(work_->drive->waits_for()->source.line);
  work_->drive->done();
  update_holds();
  return at_once();
}

BoardMachineSession::Answer BoardMachineSession::handle(request::SetPosition& set) {
  if (state_ != MachineState::idle) return Failure{why_not()};
  if (!all_finite(set.position.place)) return refusal(RefusalReason::bad_place);
  KnownPosition position = set.position;
  position.downs = this->position().downs;  // the motors stand where they stood
  stand_at(position);
  return at_once();
}

BoardMachineSession::Answer BoardMachineSession::handle(request::ResetMachine&) {
  if (auto refused = refuse(MachineEvent::reset)) return Failure{*refused};
  begin_reset();
  return at_once();
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Sleep&) {
  if (auto refused = refuse(MachineEvent::fall_asleep)) return Failure{*refused};
  move_to(MachineEvent::fall_asleep);
  return at_once();
}

BoardMachineSession::Answer BoardMachineSession::handle(request::Wake&) {
  if (auto refused = refuse(MachineEvent::wake)) return Failure{*refused};
  move_to(MachineEvent::wake);
  return at_once();
}

}  // namespace passo
