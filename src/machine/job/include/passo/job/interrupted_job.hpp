// InterruptedJob: the job of an earlier program, as its journal and the board tell of it.
#pragma once

#include <optional>
#include <string>

#include "passo/history/job_history.hpp"
#include "passo/job/job_keeper.hpp"
#include "passo/job/journaled_run.hpp"
#include "passo/link/board_session.hpp"

namespace passo {

// The job found in a journal and a board, before the board gets a new session.
struct BrokenOff {
  JournalHead head;  // its position: the board's stop point, if nothing is rejected
  std::optional<ResumeRefusal> refused;
  PathPlace done;       // all before this place is executed
  PathPlace farthest;   // nothing after this place is
  double noted_at = 0;  // when the journal was last written; seconds since 1970
};
// A status in motion is refused. Takes the numbers of the greeting that follows into the head. Write the head as the
// new journal before the board is greeted, unless the job is refused.
BrokenOff broken_off(const Journal& journal, const BoardStatus& status, const Greeting& greeting);

// Call before the board is greeted: looks in the journal for a job that was broken off, and writes there that the board
// hears this greeting next. run.is_written() is false if that cannot be written. `outlives_host`: the board is not a
// part of the program that has begun the job; else its place is lost. Nothing: there is no journal.
std::optional<BrokenOff> resume_job(JobKeeper& keeper, JournaledRun& run, const BoardStatus& status,
                                    const Greeting& greeting, bool outlives_host = true);

// An interrupted job, and the reason why it cannot continue inside its path, if any.
struct InterruptedJob {
  HistoryJob job;
  BrokenOff journal;
  std::optional<ResumePoint> point;  // its stop point on the path
  std::string code;
  std::string why;  // a sentence without a full stop
  // The point at which the machine can return to the path: its stop point, or before the last executed step.
  std::optional<ResumePoint> back_at;
  std::optional<Box> range;  // where its motors may have been stopped, if the board has lost its place
  std::string shift;         // what homing has found to be elsewhere than there; a sentence without a full stop
};

}  // namespace passo
