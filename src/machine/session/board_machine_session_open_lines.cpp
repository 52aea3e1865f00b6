// BoardMachineSession: a program that comes line by line.
#include <algorithm>

#include "work.hpp"

namespace passo {
namespace {

// Planned motion of a program that comes line by line, which may be left before more of the program is read.
constexpr Seconds least_committed{0.025};
constexpr Seconds a_wait_for_lines{0.001};

}  // namespace

// Lets a program that comes line by line go on when there are lines. True: the turn was spent waiting for more lines,
// so that the look-ahead sees them.
bool BoardMachineSession::poll_lines(Seconds most) {
  StreamedProgram* const lines = work_->lines;
  if (lines == nullptr) return false;
  MotionDrive& drive = *work_->drive;
  if (drive.holds().has(HoldReason::await_line)) {
    if (work_->drops) go_on_after_drop();
    if (lines->is_to_begin(now())) drive.resume(HoldReason::await_line);
    return false;
  }
  const bool may_wait = drive.state() == MotionDrive::State::running && !work_->drops && !options_.over_a_line;
  const bool waits = may_wait && lines->expects_more(now()) && drive.committed() >= least_committed;
  // The machine may brake for the end of the queue. Lines that have come since lead on from there.
  if (may_wait && !waits && lines->queued() > 0) drive.pass_await_line(lines->last_mode());
  if (!waits) return false;
  update_holds();
  board_.poll(std::min(most, a_wait_for_lines));
  return true;
}

// The machine rests, and the path was dropped up to here. The program goes on from where that is.
void BoardMachineSession::go_on_after_drop() {
  work_->drops = false;
  work_->lines->drop(work_->drive->dropped_to().value_or(work_->ahead.place()));
  answer_holds(Outcome::done);
}

}  // namespace passo
