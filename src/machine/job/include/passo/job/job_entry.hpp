// JobEntry: the point at which a run enters the path of its program, if not at the path's beginning, and the lead-in to
// that point.
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
  std::vector<ProbeOutcome> probes;  // the results of the probe moves before that point
};

// For a machine at the board's stop point. `head`: the head of the journal. The status must be that of a stopped board.
JobEntry entry_at_rest(const JournalHead& head, const ResumePoint& point, const BoardStatus& status,
                       const MachineDescription& machine);
// For a machine that returns to the path. `probes`: the results of the program's first probe moves.
JobEntry entry_by_way(const Reentry& way, std::vector<ProbeOutcome> probes);
void enter(request::Start& start, JobEntry entry);

}  // namespace passo
