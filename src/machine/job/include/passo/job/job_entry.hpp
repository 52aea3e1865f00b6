// JobEntry: where a run enters the path of its program, if not at the path's beginning, and how the machine gets there.
#pragma once

#include <optional>
#include <vector>

#include "passo/journal/reentry.hpp"
#include "passo/journal/resumption.hpp"
#include "passo/session/request.hpp"

namespace passo {

struct JobEntry {
  ResumePoint at;
  std::vector<PathItem> lead_in;     // from the current position to that point; empty: the machine is there
  std::optional<Point> stands;       // the current position, if it is on the path of the job; machine coordinates
  std::vector<ProbeOutcome> probes;  // what the probe moves before that place have found
};

// For a machine at the board's stop point. `head`: of the journal. The status must be one at rest.
JobEntry entry_at_rest(const JournalHead& head, const ResumePoint& point, const BoardStatus& status,
                       const MachineDescription& machine);
// For a machine that is led back onto the path. `probes`: what the program's first probe moves have found.
JobEntry entry_by_way(const Reentry& way, std::vector<ProbeOutcome> probes);
void enter(request::Start& start, JobEntry entry);

}  // namespace passo
