// GrblMachineSession: how an activity goes on, and how it ends.
#include <algorithm>
#include <cmath>
#include <utility>

#include "grbl_board_storage.hpp"
#include "grbl_work.hpp"
#include <fmt/format.h>

#include "passo/activity/nominal_time.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// A jog line that the board had received before the cancel may begin after it.
constexpr Seconds between_cancels{0.1};
constexpr double shortest_piece = 0.02;  // mm
constexpr double same_zero = 5e-3;       // mm
constexpr int pieces_ahead = 4;
// The hold of a board at rest is not reported by each firmware.
constexpr Seconds longest_wait_for_hold{0.3};

}  // namespace

void GrblMachineSession::poll_work() {
  switch (work_->stage) {
    case Work::Stage::prepares:
      update_holds();
      if (!rests()) return;
      return work_->is_board_file() ? begin_board_file() : make_feed();
    case Work::Stage::moves:
      if (work_->is_board_file()) return poll_board_file();
      if (work_->jog.line) return poll_jog();
      if (work_->feed) return poll_feed();
      return poll_home();
    case Work::Stage::brakes:
      if (sender_.stopped()) resync();
      return;
    case Work::Stage::resyncs: return end_resync();
    case Work::Stage::ended: return;
  }
}

// The modes are set, and the offsets are known: they are the zero of the lines.
void GrblMachineSession::make_feed() {
  Work& work = *work_;
  const bool is_zero_known = !connection_.asks_offsets;
  const Point zero = first_work_zero(board_);
  take_board();
  const bool is_other_zero = is_zero_known && distance(zero, first_work_zero(board_)) > same_zero;
  if (work.program && is_other_zero) return end_at_other_zero(0);
  StoredResults& results = work.program            ? work.program->answers()
                           : work.lines != nullptr ? work.lines->answers()
                                                   : work.probing.results;
  Source<PathItem>& path = work.program            ? static_cast<Source<PathItem>&>(*work.program)
                           : work.lines != nullptr ? static_cast<Source<PathItem>&>(*work.lines)
                                                   : *work.probing.line;
  const bool waits = !work.start || work.start->waits_for_operator;
  work.feed = std::make_unique<GrblFeed>(path, results, GrblTarget::of(board_), waits, stops_.optional_stop);
  sender_.follow(first_work_zero(board_), connection_.ahead);
  work.progress.lines_before = sender_.lines_sent();
  const MotionLimits limits = motion_limits(machine_);
  if (work.watchers.motion) {
    work.progress.executed.watch_passed([this, &work, limits] { play_executed(work, limits); });
  }
  work.feed->watch([&work, limits](const PathItem& item) {
    if (work.watchers.motion) work.progress.unplayed.push_back(item);
    // The way to the point where the program begins is no part of it.
    const Seconds time = work.feed->leads_in() ? Seconds(0) : nominal_time_of(item, limits);
    if (const auto* segment = std::get_if<Segment>(&item)) {
      work.progress.executed.add(segment->curve, segment->source, time,
                                 work.progress.lines_before + work.feed->lines_written(), segment->work_zero);
    } else {
      work.progress.executed.add_dwell(time);
    }
    if (work.watchers.path) work.watchers.path(item);
  });
  work.feed->watch_skipped(
      [&work, limits](const PathItem& item) { work.progress.skipped += nominal_time_of(item, limits); });
  if (work.start && work.start->from) work.feed->begin_at(*work.start->from, work.start->lead_in);
  if (work.is_program() && overrides_ != Overrides()) send_overrides();
  work.stage = Work::Stage::moves;
}

// A board that plans by itself does not report its speeds: the time is that at the commanded feed.
void GrblMachineSession::play_executed(Work& work, const MotionLimits& limits) const {
  while (!work.progress.unplayed.empty()) {
    const PathItem item = std::move(work.progress.unplayed.front());
    work.progress.unplayed.pop_front();
    if (const auto* const action = std::get_if<Action>(&item)) {
      work.watchers.motion(*action);
      continue;
    }
    PlannedMove move;
    move.begin_on(std::get<Segment>(item));
    const double factor = move.segment.rapid ? overrides_.rapids : overrides_.feed;
    move.add({.duration = nominal_time_of(item, limits) / (factor > 0 ? factor : 1)});
    move.to = move.segment.curve.length();
    return work.watchers.motion(move);
  }
}

void GrblMachineSession::poll_feed() {
  GrblFeed& feed = *work_->feed;
  // A board at rest may ignore a hold: nothing may move then either.
  while (!work_->hold.asked && sender_.wants_lines()) {
    const OutputState before = feed.outputs();
    const auto line = feed.next();
    if (feed.outputs() != before) work_->progress.outputs_line = work_->progress.lines_before + feed.lines_written();
    if (!line) break;
    sender_.add(line->text, line->line, line->silence);
  }
  work_->progress.update(sender_.dwell_left());
  if (rests() && feed.asks() != GrblFeed::Asks::nothing) answer_question();
  if (busy() && work_->stage == Work::Stage::moves) update_holds();
}

// The machine is at rest, and the path continues with what it has found.
void GrblMachineSession::answer_question() {
  GrblFeed& feed = *work_->feed;
  work_->progress.executed.finish();
  position_.place = sender_.place().value_or(position_.place);
  switch (feed.asks()) {
    case GrblFeed::Asks::nothing: return;
    case GrblFeed::Asks::operator_stop:
      // Others may move the machine now, e.g. with a pendant.
      if (!work_->hold.stop) work_->hold.stop = Work::Stop{.place = position_.place, .zero = heard_.work_zero};
      sender_.stop_following();
      if (!std::exchange(work_->hold.told, true)) {
        ++work_->progress.stops;
        update_holds();
        publish({.kind = MachineChange::Kind::came_to_rest});
      }
      return;
    case GrblFeed::Asks::line: return await_line();
    case GrblFeed::Asks::probe_state:
      heard_.contact.at.reset();
      heard_.contact.touched = false;
      feed.take_probe_state(heard_.pins.find('P') != std::string::npos, position_.place);
      return;
    case GrblFeed::Asks::probe_result: {
      const ProbeOutcome outcome{.refused = false,
                                 .touched = heard_.contact.touched && heard_.contact.at,
                                 .contact = heard_.contact.at.value_or(position_.place),
                                 .rest = position_.place};
      feed.take_probe(outcome);
      sender_.follow(first_work_zero(board_), connection_.ahead);
      if (work_->watchers.probe) work_->watchers.probe(outcome);
      return publish({.kind = MachineChange::Kind::probed, .probe = outcome});
    }
    case GrblFeed::Asks::end: return end_program();
  }
}

// While no line is there, others may move the machine, e.g. with a pendant, or set its zero. The next line is
// interpreted from where the machine is then.
void GrblMachineSession::await_line() {
  Work& work = *work_;
  if (!work.hold.line_wait) {
    work.hold.line_wait = Work::Stop{.place = position_.place, .zero = heard_.work_zero};
    sender_.stop_following();
  }
  const bool is_lined_up = work.lines->queued() > 0 || work.lines->asks();
  const auto& zero = work.hold.line_wait->zero;
  if (zero && heard_.work_zero && distance(*zero, *heard_.work_zero) > same_zero) {
    connection_.offsets_are_old = true;
    if (is_lined_up) return end_at_other_zero(0);
    switch_outputs_off();
    return end_work(Outcome::stopped);
  }
  if (distance(work.hold.line_wait->place, position_.place) > same_zero) {
    // These lines were interpreted from another place: it goes back there first, as after a program stop.
    if (!is_lined_up) {
      work.lines->drop(position_.place);
      work.hold.line_wait->place = position_.place;
    }
    work.hold.line_wait->is_moved = true;
  }
  if (!work.lines->is_to_begin(now())) return;
  const Work::Stop wait = *std::exchange(work.hold.line_wait, {});
  wait.is_moved ? work.feed->go_on_from(position_.place, wait.place) : work.feed->go_on_with_all_words();
  sender_.follow(first_work_zero(board_), connection_.ahead);
}

void GrblMachineSession::end_program() {
  const GrblFeed& feed = *work_->feed;
  if (!feed.objection().empty()) {
    work_->findings->add({.code = "grbl.cannot",
                          .file = {},
                          .place = {.line = feed.objection_line(), .column = 0},
                          .message = "a machine with Grbl cannot do this: " + feed.objection(),
                          .expected = "",
                          .text = ""});
  }
  if (work_->is_program() && overrides_ != Overrides()) {
    overrides_ = {};
    send_overrides();
  }
  // What the operator has switched on.
  if (work_->program) switch_outputs_off();
  if (work_->findings->any_error()) return end_work(Outcome::failed, ActivityFault{MachineFault::program_wrong});
  const Work::Probing& probing = work_->probing;
  auto fault = probing.line ? probing.line->fault() : std::nullopt;
  if (probing.line && probing.results.probe()->refused) {
    publish({.kind = MachineChange::Kind::probed, .probe = *probing.results.probe()});
  }
  const Outcome outcome = fault ? Outcome::failed : Outcome::done;
  end_work(outcome, std::move(fault));
}

// Sets the state of a program by its strongest reason to rest.
void GrblMachineSession::update_holds() {
  Work& work = *work_;
  if (!work.is_program() || work.stage > Work::Stage::moves || !sender_.report()) return;
  const GrblReport& report = *sender_.report();
  const bool holds = report.state == "Hold" || (work.is_board_file() && report.state == "Tool");
  const bool is_door = report.state == "Door";
  // Somebody has resumed the program at the machine.
  if (work.hold.heard && !holds && !is_door && report.state == "Run")
    work.hold.asked = work.hold.door = work.hold.heard = false;
  work.hold.heard = work.hold.heard || holds || is_door;
  if (!holds && !is_door && !work.hold.asked) work.hold.heard = false;
  const bool waits = work.feed && (rests() || work.hold.told);
  const GrblFeed::Asks asks = waits ? work.feed->asks() : GrblFeed::Asks::nothing;
  const bool is_stop = asks == GrblFeed::Asks::operator_stop;
  const bool is_tool = is_stop && work.feed->stop().kind == Action::Kind::tool_change;
  if (is_door || work.hold.door) {
    if (state_ != MachineState::door) move_to(MachineEvent::open_door);
  } else if (holds || work.hold.asked || (is_stop && !is_tool)) {
    if (state_ != MachineState::hold) move_to(MachineEvent::hold);
  } else if (is_tool) {
    if (state_ != MachineState::tool_change) move_to(MachineEvent::want_tool);
  } else if (asks == GrblFeed::Asks::line) {
    if (state_ != MachineState::await_line) move_to(MachineEvent::want_line);
  } else if (state_ != MachineState::run) {
    move_to(MachineEvent::resume);
  }
  if (!work.hold.asked || tickets_.holds.empty()) return;
  const bool is_late = now() - work.hold.at > longest_wait_for_hold;
  const bool is_at_rest = (holds || is_door) ? report.rests() : is_late && report.rests();
  if (!is_at_rest) return;
  publish({.kind = MachineChange::Kind::came_to_rest});
  answer_holds(Outcome::done);
}

void GrblMachineSession::send_jog_piece() {
  Work& work = *work_;
  const Mm piece = std::max(work.jog.ahead / pieces_ahead, Mm(shortest_piece));
  work.jog.sent = std::min(work.jog.sent + piece, work.jog.length);
  if (work.jog.length - work.jog.sent < Mm(shortest_piece)) work.jog.sent = work.jog.length;
  const Point& target = work.jog.line->target();
  const Point to = work.jog.from + (target - work.jog.from) * (work.jog.sent / work.jog.length);
  std::string text = "$J=G21G90G53";
  for (const AxisDescription& axis : machine_.axes) {
    if (target[axis.axis] == work.jog.from[axis.axis]) continue;
    text += fmt::format("{}{:.4f}", letter_of(axis.axis), to[axis.axis]);
  }
  sender_.add(text + fmt::format("F{:.3f}", std::max(0.001, work.jog.speed.value() * seconds_per_minute)));
}

// Pieces of the way are sent as the machine goes, so that little motion is left in a board that loses its host.
void GrblMachineSession::poll_jog() {
  Work& work = *work_;
  const bool is_over = now() >= work.jog.lease_end;
  if (is_over && !work.jog.cancelled_at) {
    sender_.cancel_jog();
    work.jog.cancelled_at = now();
    work.stopped = true;
  }
  if (work.jog.cancelled_at) {
    const Seconds since = now() - *work.jog.cancelled_at;
    const bool jogs = !sender_.report() || sender_.report()->state == "Jog";
    if (jogs && since > between_cancels) {
      sender_.cancel_jog();
      work.jog.cancelled_at = now();
      work.jog.freed = false;
    }
    // A report that came after the cancel.
    if (jogs || since <= GrblSender::between_urgent_questions) return;
    // If a cancel meets the end of a jog, Grbl 1.1 reports Idle but executes no line until a cycle start. To a machine
    // at rest that means nothing.
    if (sender_.report()->state == "Idle" && !std::exchange(work.jog.freed, true)) sender_.resume();
    if (!rests()) return;
    position_.place = *sender_.place();
    return end_work(Outcome::stopped);
  }
  if (!(work.jog.length > Mm(0))) return end_work(Outcome::done);
  // One line at a time lies in the board's buffer: a cancel does not clear it there.
  const Mm travelled(distance(work.jog.from, live_.at()));
  if (sender_.all_answered() && work.jog.sent < work.jog.length && work.jog.sent - travelled < work.jog.ahead)
    send_jog_piece();
  if (work.jog.sent < work.jog.length || !rests()) return;
  position_.place = *sender_.place();
  end_work(Outcome::done);
}

// After the homing of a single axis the place is known if it was before, or when all axes have been homed.
bool GrblMachineSession::knows_place_after(std::optional<Axis> homed) {
  if (!homed) return true;
  if (position_.trust != Trust::unknown) return false;
  recovery_.homed.add(*homed);
  const bool any_home = !machine_.homing.empty();
  return std::ranges::all_of(machine_.axes, [&](const AxisDescription& axis) {
    return recovery_.homed.has(axis.axis) || (any_home && !axis.home);
  });
}

void GrblMachineSession::poll_home() {
  if (!rests()) return;
  locked_ = false;
  position_.place = *sender_.place();
  live_.rest_at(position_.place);
  if (knows_place_after(work_->homes)) {
    recovery_ = {};
    position_.trust = Trust::homed;
    position_.is_lost = false;
  }
  // Homing may move the zero of the work: startup lines ($N0) run after it.
  ask_for_offsets();
  end_work(Outcome::done);
}

// The board has forgotten what it held. It tells where that has left it.
void GrblMachineSession::resync() {
  const bool needs_reset = !sender_.stopped();
  if (needs_reset) port_.send("\x18");
  connect_again(true);
  work_->stage = Work::Stage::resyncs;
}

void GrblMachineSession::end_resync() {
  if (!sender_.ready()) return;
  const bool is_locked = sender_.report()->state == "Alarm";
  if (!connection_.is_prepared && !is_locked) return prepare();
  if (!(is_locked ? sender_.all_answered() : rests())) return;
  take_board();
  position_.place = sender_.place().value_or(position_.place);
  live_.rest_at(position_.place);
  locked_ = is_locked;
  overrides_ = {};
  if (is_locked) lose_place();
  if (work_->drops && !work_->fault) {
    work_->drops = false;
    work_->lines->drop(position_.place);
    answer_holds(Outcome::done);
    return make_feed();
  }
  const Outcome without_fault = work_->board_file.has_ended ? Outcome::done : Outcome::stopped;
  end_work(work_->fault ? Outcome::failed : without_fault, work_->fault);
}

void GrblMachineSession::end_work(Outcome outcome, std::optional<ActivityFault> fault) {
  Work& work = *work_;
  work.stage = Work::Stage::ended;
  sender_.look_often(false);
  sender_.stop_following();
  const auto place = sender_.place();
  if (place && rests()) position_.place = *place;
  live_.rest_at(position_.place);
  move_to(MachineEvent::end);
  answer(work.ticket, outcome, std::move(fault));
  answer_holds(outcome == Outcome::failed ? Outcome::failed : Outcome::done);
}

// The sender has ended because of a fault.
void GrblMachineSession::check_fault() {
  const auto& fault = sender_.fault();
  if (!fault || state_ == MachineState::alarm || state_ == MachineState::fault) return;
  if (fault->code == "grbl.alarm") return break_off(MachineEvent::stop_at_once, *fault);
  const bool is_heard = fault->code == "grbl.error" || sender_.stops();
  if (busy() && !work_->checker && is_heard) return check_fault_of_work(*fault);
  if (busy() && work_->stage == Work::Stage::brakes && work_->fault) return;  // it ends with that
  // A question that an idle board has refused.
  if (fault->code == "grbl.error" && state_ != MachineState::offline) return connect_again(true);
  break_off(MachineEvent::lose_board, *fault);
}

// A line that was refused or lost: the board brakes, and the activity ends.
void GrblMachineSession::check_fault_of_work(const GrblFault& fault) {
  if (work_->stage == Work::Stage::resyncs) return break_off(MachineEvent::lose_board, fault);
  if (work_->fault) return;
  work_->drops = false;
  trouble_.fault = fault;
  if (work_->program && fault.code == "grbl.error") {
    work_->findings->add({.code = fault.code,
                          .file = {},
                          .place = {.line = fault.last_line, .column = 0},
                          .message = fault.message,
                          .expected = "",
                          .text = ""});
    work_->fault = ActivityFault{MachineFault::program_wrong};
  } else {
    const Sentence sentence = sentence_of(fault);
    work_->fault = ActivityFault{MachineFault::board_stopped, {{"trouble", sentence.text}}, sentence};
  }
  if (sender_.stops() || sender_.stopped()) {
    work_->stage = Work::Stage::brakes;
  } else {
    resync();
  }
}

std::string GrblMachineSession::words_of_restart() const {
  if (!busy() || !work_->feed || work_->program == nullptr) return {};
  const std::uint32_t line = work_->progress.executed.source().line;
  if (line == 0) return {};
  return fmt::format(
      "; by its last reports the machine was at line {} of the program: home it or set its zero, and start at that "
      "line",
      line);
}

Sentence GrblMachineSession::sentence_of(const GrblFault& fault) const {
  const bool goes_on =
      busy() && work_->is_board_file() && (fault.code == "grbl.line-lost" || fault.code == "grbl.no-answer");
  if (goes_on) {
    return {.code = fault.code,
            .text = fmt::format("{}; the board may go on with {} by itself: stop it at the machine, or press Reset",
                                fault.message, work_->board_file.path)};
  }
  return {.code = fault.code, .text = fault.message + words_of_restart()};
}

// The board stops at once. A board that stood still keeps its place: if it did not, it is in an alarm after the reset.
void GrblMachineSession::stop_by_reset() {
  const auto& report = sender_.report();
  const bool stands = rests() || (report && report->rests() && (!busy() || work_->hold.asked));
  const KnownPosition before = position_;
  const bool was_lost = recovery_.lacks_place;
  const std::string words = "the machine was reset by hand";
  break_off(
      MachineEvent::stop_at_once,
      {.code = "grbl.reset",
       .message = words + (stands ? " while it stood still" : " in motion: it stopped at once, and lost its position"),
       .first_line = 0,
       .last_line = 0});
  if (!stands) return;
  position_ = before;
  recovery_.lacks_place = was_lost;
}

// The board may have moved further, or lost steps.
void GrblMachineSession::break_off(MachineEvent event, const GrblFault& fault) {
  const Sentence sentence = sentence_of(fault);
  loan_.lent = false;
  loan_.storage->lose();
  connection_.asks_offsets = false;
  trouble_ = {sentence, fault};
  if (state_ != MachineState::offline) {
    lose_place();
    recovery_.lacks_place = true;
  }
  if (busy()) {
    const MachineFault kind =
        event == MachineEvent::stop_at_once ? MachineFault::board_stopped : MachineFault::board_lost;
    work_->stage = Work::Stage::ended;
    answer(work_->ticket, Outcome::failed, ActivityFault{kind, {{"trouble", sentence.text}}, sentence});
    answer_holds(Outcome::failed);
  }
  position_.place = live_.at();
  move_to(event);
}

}  // namespace passo
