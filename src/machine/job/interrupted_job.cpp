#include "passo/job/interrupted_job.hpp"

#include "passo/journal/cut_between.hpp"

namespace passo {

BrokenOff broken_off(const Journal& journal, const BoardStatus& status, const Greeting& greeting) {
  BrokenOff found{.head = journal.head(),
                  .refused = refuse_rest(journal, status),
                  .done = journal.done(),
                  .farthest = journal.farthest(),
                  .began = journal.head().place,
                  .run = run_of(journal.head())};
  if (!found.refused && (status.state & board_moves) != 0) found.refused = ResumeRefusal::rest_unknown;
  if (found.refused) return found;
  found.head.place = found.done = found.farthest = *journal.place_of(status);
  found.head.numbers = {.session_before = status.session,
                        .executed_before = status.executed,
                        .greeting = greeting.number,
                        .session = greeting.session};
  return found;
}

std::optional<BrokenOff> resume_job(JobKeeper& keeper, JournaledRun& run, const BoardStatus& status,
                                    const Greeting& greeting, bool outlives_host) {
  const auto journal = Journal::read(keeper.read());
  if (!journal) return {};
  BrokenOff found = broken_off(*journal, status, greeting);
  found.noted_at = keeper.noted_at();
  if (!outlives_host) found.refused = ResumeRefusal::board_reset;
  // What cannot be written shows in the run.
  if (!found.refused) static_cast<void>(run.begin(found.head));
  return found;
}

}  // namespace passo
