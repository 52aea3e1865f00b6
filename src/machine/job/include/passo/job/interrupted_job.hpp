// InterruptedJob: the job of an earlier program, as its journal and the board tell of it.
#pragma once

#include <optional>
#include <string>

#include "passo/history/job_history.hpp"
#include "passo/job/job_keeper.hpp"
#include "passo/job/journaled_run.hpp"
#include "passo/link/board_session.hpp"

namespace passo {

// What a journal and a board tell of a job, before the board hears of a new session.
struct BrokenOff {
  JournalHead head;  // its place: where the board rests, if nothing is refused
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

// A job that was broken off, and why it cannot go on amid its path, if it cannot.
struct InterruptedJob {
  HistoryJob job;
  BrokenOff journal;
  std::optional<ResumePoint> point;  // where it rests on its path
  Sentence why;                      // without a code: it can
  // Where the machine may be led back onto the path: where it rests, or else before the last executed step.
  std::optional<ResumePoint> back_at;
  std::optional<Box> range;  // where its motors may have been stopped, if the board has lost its place
  std::string shift;         // what homing has found to be elsewhere than there; a sentence without a full stop
};

}  // namespace passo
