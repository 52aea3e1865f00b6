// ParkedJob: a job that waits for a person, whose motion has ended so that the person may jog, probe or set a zero.
//
// Going on is a new start behind the same stop: the program is interpreted anew with the zeros and tools that count
// now, and the tool is led back to where the program has left it, in these zeros. See docs/decisions/0157. Other jobs
// may run meanwhile: a probing cycle is one. Private to api/.
#pragma once

#include <vector>

#include "passo/api/api_job.hpp"
#include "passo/api/program_store.hpp"
#include "passo/job/kept_job.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

struct ParkedJob {
  ApiJob job;
  OperatorWait wait;
  SavedParameters parameters;  // of then
  ToolTable tools;
  Point start;                       // where its path begins
  std::vector<ProbeOutcome> probes;  // what it has probed

  // From where the machine stands to behind the stop.
  Result<Reentry, Sentence> way_behind_stop(const MachineDescription& machine, const ProgramStore& programs,
                                            const Point& stands) const;
};

}  // namespace passo
