#include "passo/job/journaled_run.hpp"

#include <utility>

namespace passo {

bool JournaledRun::begin(const JournalHead& head, std::optional<JobEntry> entry) {
  entry_ = std::move(entry);
  writer_.begin(head);
  return is_written();
}

void JournaledRun::add_to(request::Start& start) {
  if (entry_) enter(start, *entry_);
  start.watchers.probe = [this](const ProbeOutcome& outcome) { writer_.record(outcome); };
  start.watchers.rests = [this](const BoardStop& rest) { writer_.record(rest); };
}

}  // namespace passo
