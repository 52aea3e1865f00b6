// BoardMachineSession: why a program rests, and what a person changes meanwhile.
#include <string>
#include <utility>

#include "work.hpp"

namespace passo {

// Stops the jog in time. The moves that one step commits may not end after the lease.
void BoardMachineSession::check_lease() {
  const Seconds pulled = 3 * live_commitment.longest_move;
  if (work_->lease.is_over_at(now() + work_->drive->committed() + pulled)) work_->drive->stop();
}

// As in grbl, the operator's factors are 100 % again after M2 and M30.
void BoardMachineSession::end_overrides() {
  overrides_ = {.adaptive_feed = overrides_.adaptive_feed};
  ++version_;
  if (busy()) put_overrides_on(*work_->drive);
}

// Sets the state of a program by its strongest reason to rest.
void BoardMachineSession::update_holds() {
  if (!work_->is_program() || !work_->drive) return;
  const MotionDrive& drive = *work_->drive;
  const HoldReasons holds = drive.holds();
  const bool held = drive.state() == MotionDrive::State::held;
  report_tails();
  if (holds.has(HoldReason::door)) {
    if (state_ != MachineState::door) move_to(MachineEvent::open_door);
  } else if (holds.any_of({HoldReason::operator_hold, HoldReason::program_stop, HoldReason::line_end}) ||
             (held && holds.has(HoldReason::zero_feed) &&
              !holds.any_of({HoldReason::tool_change, HoldReason::await_line}))) {
    if (state_ != MachineState::hold) move_to(MachineEvent::hold);
  } else if (holds.has(HoldReason::tool_change)) {
    if (state_ != MachineState::tool_change) move_to(MachineEvent::want_tool);
  } else if (holds.has(HoldReason::await_line)) {
    if (state_ != MachineState::await_line) move_to(MachineEvent::want_line);
  } else if (state_ != MachineState::run && !drive.stopped()) {
    move_to(MachineEvent::resume);
  }
  if (!work_->rest.begins(held)) return;
  publish({.kind = MachineChange::Kind::came_to_rest});
  answer_holds(Outcome::done);
}

// A hold as for a door: at rest, spindle and coolant are off.
void BoardMachineSession::update_door() {
  const bool rests = work_->drive->state() == MotionDrive::State::held;
  if (rests && work_->rest.take_stop_of_outputs()) work_->drive->stop_outputs();
}

// A spindle that this computer controls turns only for a program. If it fails, the program is held, and the outputs are
// off as behind an open door.
void BoardMachineSession::poll_spindle() {
  HostSpindle* const spindle = options_.spindle;
  if (spindle == nullptr) return;
  const bool may_turn = busy() && work_->is_program() && work_->drive;
  if (!may_turn) spindle->order({});
  if (!spindle->take_new_fault() || !may_turn) return;
  work_->drive->hold(HoldReason::operator_hold);
  work_->rest.hold(true);
  update_holds();
}

std::optional<Refusal> BoardMachineSession::refuse_spindle() const {
  HostSpindle* const spindle = options_.spindle;
  if (spindle == nullptr || spindle->clear_fault()) return {};
  const HostSpindleStatus status = spindle->status();
  if (!status.has_failed()) return Refusal{RefusalReason::spindle_failed, {{"why", "its drive does not answer"}}};
  SentenceArguments arguments{{"why", status.fault.text}, {"why.code", status.fault.code}};
  for (const auto& [name, value] : status.fault.arguments) arguments.emplace_back("why.arguments." + name, value);
  return Refusal{RefusalReason::spindle_failed, std::move(arguments)};
}

void BoardMachineSession::report_tails() {
  const QueueUpdateLedger* const tails = work_->drive->ledger();
  for (; tails != nullptr && work_->recoveries_told < tails->recoveries(); ++work_->recoveries_told) {
    publish({.kind = MachineChange::Kind::rested_by_tail});
  }
}

void BoardMachineSession::put_overrides_on(MotionDrive& drive) const {
  drive.set_feed_override(overrides_.feed);
  drive.set_adaptive_feed(overrides_.adaptive_feed);
  drive.set_spindle_override(overrides_.spindle);
  drive.set_rapid_override(overrides_.rapids);
}

}  // namespace passo
