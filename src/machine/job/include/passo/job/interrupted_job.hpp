// InterruptedJob: the unfinished job of an earlier process, found from its journal and the board's status.
#pragma once

#include <optional>
#include <string>

#include "passo/job/job_history.hpp"
#include "passo/job/job_keeper.hpp"
#include "passo/job/journaled_run.hpp"
#include "passo/link/board_session.hpp"

namespace passo {

// The job found in a journal and a board, before the board gets a new session.
struct BrokenOff {
  JournalHead head;  // its position is the board's stop point, unless the job is rejected
  std::optional<ResumeRefusal> refused;
  PathPosition done;      // everything before this position is executed
  PathPosition farthest;  // nothing after this position is executed
  PathPosition began;     // where the run of the journal began
  std::string run;        // run_of() its journal
  double noted_at = 0;    // time of the last write to the journal; seconds since 1970
};
// Rejects a status during motion. Puts the numbers of the coming handshake into the head. Unless the job is rejected,
// write the head as the new journal before the handshake.
BrokenOff broken_off(const Journal& journal, const BoardStatus& status, const Greeting& greeting);

// Call before the handshake: looks in the journal for an interrupted job, and records the coming handshake there.
// run.is_written() is false if the journal cannot be written. `outlives_host`: the board is not a part of the process
// that began the job; otherwise its position is lost. Nothing: there is no journal.
std::optional<BrokenOff> resume_job(JobKeeper& keeper, JournaledRun& run, const BoardStatus& status,
                                    const Greeting& greeting, bool outlives_host = true);

// An interrupted job, and the reason why it cannot continue inside its path, if any.
struct InterruptedJob {
  HistoryJob job;
  BrokenOff journal;
  std::optional<ResumePoint> point;  // its stop point on the path
  Sentence why;                      // without a code: it can continue
  // The point at which the machine can return to the path: its stop point, or before the last executed step.
  std::optional<ResumePoint> back_at;
  std::optional<Box> range;  // the possible stop positions, if the board has lost its position
  std::string shift;         // the difference found by homing, as a sentence without a full stop
};

}  // namespace passo
