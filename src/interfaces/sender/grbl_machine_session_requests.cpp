// GrblMachineSession: how the session answers each request.
#include <algorithm>
#include <cmath>
#include <utility>

#include "grbl_board_storage.hpp"
#include "grbl_work.hpp"
#include <fmt/format.h>

#include "passo/geometry/euclid.hpp"
#include "passo/session/request_checks.hpp"

namespace passo {
namespace {

constexpr double least_feed_factor = 0.1;
constexpr double same_position = 5e-3;  // mm
constexpr Seconds longest_grbl_homing{300};
constexpr int setting_of_homing = 22;

Failure<Refusal> refused(RefusalReason reason) {
  return Failure{Refusal{reason}};
}

int percent_of(double factor) {
  return static_cast<int>(std::lround(factor * 100));
}

}  // namespace

MachineAbilities GrblMachineSession::abilities() const {
  MachineAbilities abilities;
  const auto lack = [&](Ability ability, const char* code, const char* why) {
    abilities.lack(ability, {.code = std::string("ability.grbl.") + code, .text = why});
  };
  lack(Ability::exact_resume, "exact-resume",
       "this board does not report which step it has made: an interrupted job continues at the beginning of a line");
  lack(Ability::step_counts, "step-counts", "this board does not report its step counts");
  lack(Ability::pulses, "pulses", "this board plans its own motion, so its step pulses are not known here");
  lack(Ability::adaptive_feed, "adaptive-feed", "this board does not know M52; use the feed override");
  lack(Ability::any_override, "any-override",
       "this board changes feed and spindle speed by 10 to 200 %, and rapids to 100, 50 or 25 %");
  lack(Ability::single_block, "single-block", "this board plans ahead over several lines; use hold");
  if (!board_.homes_single_axes()) lack(Ability::home_axis, "home-axis", "this board homes all its axes together");
  lack(Ability::set_position, "set-position",
       "this board keeps its own position: home it, or set the zero of the work");
  lack(Ability::thread, "thread", "this board cannot follow the spindle");
  const auto homing = board_.settings.find(setting_of_homing);
  if (homing != board_.settings.end() && homing->second == 0) {
    lack(Ability::home, "home", "homing is off on this board ($22=0)");
    lack(Ability::home_axis, "home", "homing is off on this board ($22=0)");
  }
  if (const auto files = BoardFiles::of(board_); !files) {
    abilities.lack(Ability::board_files, {.code = "ability.board-files", .text = files.error()});
  }
  return abilities;
}

GrblMachineSession::Answer GrblMachineSession::refuse_ability(Ability ability) const {
  return Failure{refusal_of(abilities(), ability)};
}

Result<Ticket, Refusal> GrblMachineSession::request(Request wanted) {
  if (loan_.storage->uploads() && std::holds_alternative<request::Stop>(wanted)) {
    loan_.storage->cancel();
    return at_once();
  }
  if (loan_.lent) return refused(RefusalReason::busy);
  return std::visit([this](auto& one) { return handle(one); }, wanted);
}

std::optional<Refusal> GrblMachineSession::refuse(MachineEvent event) const {
  if (next_state(state_, event)) return {};
  return refusal_in(state_, busy());
}

// A board that is held makes no motion, and answers lines that it does not execute.
std::optional<Refusal> GrblMachineSession::refuse_motion(MachineEvent event) const {
  if (auto refusal = refuse(event)) return refusal;
  if (!is_held_at_board()) return {};
  if (heard_.pins.find('H') != std::string::npos) {
    return refused_because("ability.grbl.hold-input-first",
                           "the hold input of the board is active: release it, then press Resume");
  }
  return refused_because("ability.grbl.held", "the board is held: press Resume, here or at the board");
}

// A place of the file may not be on the board.
std::optional<Refusal> GrblMachineSession::refuse_path() const {
  if (!match_.objection) return {};
  return refused_because(match_.objection->code, match_.objection->text);
}

GrblMachineSession::Answer GrblMachineSession::at_once() {
  const Ticket ticket = ++tickets_.last;
  answer(ticket, Outcome::done);
  return ticket;
}

GrblMachineSession::Answer GrblMachineSession::begin(MachineEvent event, std::unique_ptr<Work> work) {
  work_ = std::move(work);
  work_->ticket = ++tickets_.last;
  trouble_.fault.reset();
  sender_.look_often(true);
  move_to(event);
  return work_->ticket;
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Start& start) {
  if (auto refusal = refuse_motion(MachineEvent::begin_run)) return Failure{*refusal};
  if (auto refusal = lost_place()) return Failure{*refusal};
  if (auto refusal = refuse_path()) return Failure{*refusal};
  auto work = std::make_unique<Work>();
  if (start.findings != nullptr) work->findings = start.findings;
  work->watchers = start.watchers;
  if (start.from) work->progress.stops = start.from->stops;
  work->start = std::move(start);
  work->start->options.start = work->start->from ? work->start->options.start : position_.place;
  work->program = std::make_unique<GrblProgramPath>(std::move(work->start->program), machine_, work->start->options,
                                                    *work->findings, std::move(work->start->known_probes));
  if (work->watchers.operations) {
    work->program->operations().watch([&one = *work](const Operation& operation) {
      if (!one.feed->leads_in()) one.watchers.operations(operation);
    });
  }
  prepare();
  return begin(MachineEvent::begin_run, std::move(work));
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Stream& stream) {
  if (auto refusal = refuse_motion(MachineEvent::begin_run)) return Failure{*refusal};
  if (auto refusal = lost_place(); refusal && !stream.program->jogs()) return Failure{*refusal};
  if (auto refusal = refuse_path(); refusal && !stream.program->jogs()) return Failure{*refusal};
  unlock();
  auto work = std::make_unique<Work>();
  work->kind = stream.program->jogs() ? ActivityKind::jog : ActivityKind::program;
  work->lines = stream.program;
  work->watchers = stream.watchers;
  prepare();
  return begin(MachineEvent::begin_run, std::move(work));
}

// The board brakes, and forgets what it holds. The stream goes on from there.
GrblMachineSession::Answer GrblMachineSession::handle(request::DropLines&) {
  if (!busy() || work_->lines == nullptr) return refused(RefusalReason::no_lines_queued);
  const Ticket ticket = tickets_.holds.emplace_back(++tickets_.last);
  work_->lines->drop(position_.place);
  if (!std::exchange(work_->drops, true) && work_->stage < Work::Stage::brakes) {
    sender_.stop();
    work_->stage = Work::Stage::brakes;
  }
  return ticket;
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Jog& jog) {
  if (auto refusal = refuse_motion(MachineEvent::begin_jog)) return Failure{*refusal};
  if (auto refusal = refusal_of(jog)) return Failure{*refusal};
  unlock();
  auto work = std::make_unique<Work>();
  work->kind = ActivityKind::jog;
  work->stage = Work::Stage::moves;
  work->jog.from = position_.place;
  work->jog.line = std::make_unique<JogLine>(machine_, position_.place, jog.way, position_.trust != Trust::unknown);
  work->jog.length = Mm(distance(work->jog.from, work->jog.line->target()));
  work->jog.highest = jog.way.speed;
  double least_acceleration = 1e9;
  for (const AxisDescription& axis : machine_.axes) {
    if (jog.way.direction[axis.axis] == 0) continue;
    work->jog.highest = std::min(work->jog.highest, axis.velocity);
    least_acceleration = std::min(least_acceleration, axis.acceleration.value());
  }
  work->jog.acceleration = MmPerSecond2(least_acceleration);
  work->jog.set_share(jog.share);
  work->jog.lease = jog.lease;
  work->jog.lease_end = now() + jog.lease;
  return begin(MachineEvent::begin_jog, std::move(work));
}

GrblMachineSession::Answer GrblMachineSession::handle(request::RenewKeepAlive& renew) {
  if (state_ != MachineState::jog) return refused(RefusalReason::no_jog);
  if (auto refusal = refusal_of(renew)) return Failure{*refusal};
  if (renew.share) work_->jog.set_share(*renew.share);
  work_->jog.lease_end = now() + work_->jog.lease;
  return at_once();
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Home& home) {
  if (auto refusal = refuse_motion(MachineEvent::begin_home)) return Failure{*refusal};
  const Ability needed = home.axis ? Ability::home_axis : Ability::home;
  if (!abilities().can(needed)) return refuse_ability(needed);
  auto work = std::make_unique<Work>();
  work->kind = ActivityKind::homing;
  work->stage = Work::Stage::moves;
  work->homes = home.axis;
  sender_.add(home.axis ? fmt::format("$H{}", letter_of(*home.axis)) : "$H", 0, longest_grbl_homing);
  return begin(MachineEvent::begin_home, std::move(work));
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Probe& probe) {
  if (auto refusal = refuse_motion(MachineEvent::begin_probe)) return Failure{*refusal};
  if (auto refusal = refusal_of(probe, machine_, position_, Mm(same_position))) return Failure{*refusal};
  unlock();
  auto work = std::make_unique<Work>();
  work->kind = ActivityKind::probing;
  work->probing.line =
      std::make_unique<ProbeLine>(position_.place, probe.target, probe.speed, probe.toward, work->probing.results);
  prepare();
  return begin(MachineEvent::begin_probe, std::move(work));
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Check& check) {
  if (auto refusal = refuse(MachineEvent::begin_check)) return Failure{*refusal};
  auto work = std::make_unique<Work>();
  if (check.findings != nullptr) work->findings = check.findings;
  check.options.start = position_.place;
  work->checker = std::make_unique<ProgramChecker>(std::move(check.program), machine_, check.options, *work->findings);
  return begin(MachineEvent::begin_check, std::move(work));
}

GrblMachineSession::Answer GrblMachineSession::handle(request::RunBoardFile& run) {
  if (auto refusal = refuse_motion(MachineEvent::begin_run)) return Failure{*refusal};
  const auto files = BoardFiles::of(board_);
  if (!files) return refuse_ability(Ability::board_files);
  if (auto refusal = lost_place()) return Failure{*refusal};
  auto line = files->run_line(run.path);
  if (!line) return Failure{refused_because("board-files.bad-path", line.error())};
  auto work = std::make_unique<Work>();
  work->board_file.path = std::move(run.path);
  work->board_file.line = std::move(*line);
  prepare();
  return begin(MachineEvent::begin_run, std::move(work));
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Hold& hold) {
  if (!busy() || state_ == MachineState::check) return refused(RefusalReason::nothing_moves);
  if (!work_->is_program()) {
    request::Stop stop;
    return handle(stop);
  }
  const Ticket ticket = ++tickets_.last;
  tickets_.holds.push_back(ticket);
  work_->hold.asked = true;
  work_->hold.door = hold.for_door;
  work_->hold.told = false;
  work_->hold.at = now();
  hold.for_door ? sender_.open_door() : sender_.hold();
  update_holds();
  return ticket;
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Resume&) {
  // While the board brakes or is reset, it would move on.
  if (busy() && work_->stage >= Work::Stage::brakes) return refused(RefusalReason::no_program_held);
  const bool is_held = busy() && work_->is_program() && (work_->hold.asked || work_->hold.heard);
  const bool is_held_idle = state_ == MachineState::idle && is_held_at_board();
  const bool is_door_closed = state_ == MachineState::door && heard_.pins.find('D') == std::string::npos;
  if (!is_held && !is_held_idle && !is_door_closed) return refused(RefusalReason::no_program_held);
  if (heard_.pins.find('D') != std::string::npos) return refused(RefusalReason::door_open);
  if (heard_.pins.find('H') != std::string::npos) {
    return Failure{refused_because("ability.grbl.hold-input",
                                   "the hold input of the board is still active: release it, then resume")};
  }
  if (busy()) work_->hold.asked = work_->hold.door = work_->hold.heard = false;
  sender_.resume();
  answer_holds(Outcome::stopped);  // those that were called off before the machine came to rest
  return at_once();
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Stop&) {
  if (!busy()) return refused(RefusalReason::nothing_going_on);
  const Ticket ticket = tickets_.holds.emplace_back(++tickets_.last);
  work_->stopped = true;
  work_->drops = false;
  if (work_->checker || work_->stage >= Work::Stage::brakes) return ticket;
  // A machine at rest needs no brake and no reset: only its outputs are switched off.
  if (work_->feed && work_->feed->asks() != GrblFeed::Asks::nothing && rests()) {
    switch_outputs_off();
    end_work(Outcome::stopped);
    return ticket;
  }
  if (work_->jog.line) {
    sender_.cancel_jog();
    work_->jog.cancelled_at = now();
  } else {
    sender_.stop();
    work_->stage = Work::Stage::brakes;
  }
  return ticket;
}

void GrblMachineSession::send_overrides() {
  sender_.override_feed(percent_of(overrides_.feed));
  sender_.override_spindle(percent_of(overrides_.spindle));
  sender_.override_rapids(percent_of(overrides_.rapids));
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Override& change) {
  if (change.adaptive_feed && *change.adaptive_feed != 1) return refuse_ability(Ability::adaptive_feed);
  if (auto refusal = refusal_of(change)) return Failure{*refusal};
  for (const auto& factor : {change.feed, change.spindle}) {
    if (factor && *factor < least_feed_factor) return refuse_ability(Ability::any_override);
  }
  if (state_ == MachineState::offline || state_ == MachineState::fault) return Failure{refusal_in(state_, busy())};
  if (change.feed) {
    overrides_.feed = percent_of(*change.feed) / 100.0;
    sender_.override_feed(percent_of(*change.feed));
  }
  if (change.spindle) {
    overrides_.spindle = percent_of(*change.spindle) / 100.0;
    sender_.override_spindle(percent_of(*change.spindle));
  }
  if (change.rapids) overrides_.rapids = sender_.override_rapids(percent_of(*change.rapids)) / 100.0;
  ++news_.version;
  return at_once();
}

GrblMachineSession::Answer GrblMachineSession::handle(request::SwitchOutputs& wanted) {
  if (!busy() || !work_->is_program() || work_->stage != Work::Stage::moves) {
    return refused(RefusalReason::no_program_runs);
  }
  if (auto refusal = refusal_of(wanted, machine_)) return Failure{*refusal};
  if (wanted.spindle_stands && state_ != MachineState::hold) return refused(RefusalReason::spindle_turns);
  std::string& on = heard_.outputs ? *heard_.outputs : heard_.outputs.emplace();
  const auto is_on = [&on](char letter) { return on.find(letter) != std::string::npos; };
  // The board only knows how to toggle them. A second request may come before its report of the first.
  const auto note = [&](char letter) { is_on(letter) ? std::erase(on, letter) : (on += letter).size(); };
  if (wanted.mist && *wanted.mist != is_on('M')) {
    sender_.toggle_mist();
    note('M');
  }
  if (wanted.flood && *wanted.flood != is_on('F')) {
    sender_.toggle_flood();
    note('F');
  }
  if (wanted.spindle_stands && *wanted.spindle_stands == (is_on('S') || is_on('C'))) sender_.toggle_spindle_stop();
  ++news_.version;
  return at_once();
}

GrblMachineSession::Answer GrblMachineSession::handle(request::ChooseStops& chosen) {
  if (chosen.single_block.value_or(false)) return refuse_ability(Ability::single_block);
  stops_.optional_stop = chosen.optional_stop.value_or(stops_.optional_stop);
  if (busy() && work_->feed) work_->feed->wait_at_optional(stops_.optional_stop);
  ++news_.version;
  return at_once();
}

GrblMachineSession::Answer GrblMachineSession::handle(request::OperatorDone&) {
  const bool waits = busy() && work_->feed && work_->feed->asks() == GrblFeed::Asks::operator_stop && rests();
  if (!waits) return refused(RefusalReason::not_waiting);
  const std::uint32_t line = work_->feed->stop().source.line;
  if (work_->program) work_->program->operator_messages().pass(line);
  if (work_->lines != nullptr) work_->lines->operator_messages().pass(line);
  work_->hold.told = false;
  const Work::Stop stop = *std::exchange(work_->hold.stop, {});
  const bool is_zero_moved = stop.zero && heard_.work_zero && distance(*stop.zero, *heard_.work_zero) > same_position;
  if (is_zero_moved) {
    connection_.offsets_are_old = true;
    end_at_other_zero(line);
    return at_once();
  }
  work_->feed->go_on_from(*sender_.place(), stop.place);
  sender_.follow(first_work_zero(board_), connection_.ahead);
  update_holds();
  return at_once();
}

// The program has been interpreted with the old one.
void GrblMachineSession::end_at_other_zero(std::uint32_t line) {
  trouble_.fault = GrblFault{.code = "grbl.zero-changed",
                             .message =
                                 "the work zero was changed at the machine in the meantime. Start the program "
                                 "again, after the line at which it waited: it then uses the new zero",
                             .first_line = line,
                             .last_line = line};
  switch_outputs_off();
  const Sentence sentence{.code = trouble_.fault->code, .text = trouble_.fault->message};
  end_work(Outcome::failed, ActivityFault{MachineFault::board_stopped, {{"trouble", sentence.text}}, sentence});
}

void GrblMachineSession::switch_outputs_off() {
  if (!work_->feed || (work_->feed->outputs() == OutputState() && outputs_now() == OutputState())) return;
  sender_.add("M5");
  sender_.add("M9");
}

// The board knows no other place. That it stands where it is shown can be confirmed.
GrblMachineSession::Answer GrblMachineSession::handle(request::SetPosition& set) {
  if (state_ != MachineState::idle) return Failure{refusal_in(state_, busy())};
  if (!all_finite(set.position.place)) return refused(RefusalReason::bad_place);
  if (distance(set.position.place, position_.place) > same_position) return refuse_ability(Ability::set_position);
  unlock();
  recovery_ = {};
  position_.trust = Trust::counted;  // by the board, from a place that a person has confirmed
  position_.is_lost = false;
  ++news_.version;
  return at_once();
}

GrblMachineSession::Answer GrblMachineSession::handle(request::ResetMachine&) {
  if (busy() || state_ == MachineState::door) stop_by_reset();
  if (auto refusal = refuse(MachineEvent::reset)) return Failure{*refusal};
  trouble_ = {};
  if (port_.is_broken()) {
    connection_.broken_since = now();
  } else {
    port_.send("\x18");
    connect_again(true);
  }
  move_to(MachineEvent::reset);
  return at_once();
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Sleep&) {
  if (auto refusal = refuse(MachineEvent::fall_asleep)) return Failure{*refusal};
  move_to(MachineEvent::fall_asleep);
  return at_once();
}

GrblMachineSession::Answer GrblMachineSession::handle(request::Wake&) {
  if (auto refusal = refuse(MachineEvent::wake)) return Failure{*refusal};
  move_to(MachineEvent::wake);
  return at_once();
}

}  // namespace passo
