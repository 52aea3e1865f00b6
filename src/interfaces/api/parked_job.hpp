// ParkedJob: a job that waits for the operator, whose motion has ended so that the operator may jog, probe or set a
// zero.
//
// To continue is to restart after the same stop: the program is interpreted again with the current offsets and tools,
// and the tool returns to the position where the program has left it, relative to these offsets. See
// docs/decisions/0157. Other jobs, such as a probing cycle, may run in between. Private to api/.
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
  SavedParameters parameters;  // parameters at the start of the job
  ToolTable tools;
  Point start;                       // start position of the job's path
  std::vector<ProbeOutcome> probes;  // probe results of the job

  // Returns the reentry from the current machine position to the point after the stop.
  Result<Reentry, Sentence> way_behind_stop(const MachineDescription& machine, const ProgramStore& programs,
                                            const Point& stands) const;
};

}  // namespace passo
