#include "passo/job/job_end.hpp"

namespace passo {

Answered answer_of(const std::vector<MachineChange>& changes, Ticket ticket) {
  for (const MachineChange& change : changes) {
    if (change.kind != MachineChange::Kind::answered || change.ticket != ticket) continue;
    return {.outcome = change.outcome, .fault = change.fault};
  }
  return {.outcome = Outcome::stopped, .fault = {}};
}

JobEnd end_of_run(const Answered& answered, std::optional<LinkError> trouble, bool is_resumed) {
  const bool is_done = !trouble && answered.outcome == Outcome::done;
  const bool is_refused = answered.refused && answered.refused->code() != RefusalCode::place_unknown;
  const bool is_of_program = answered.fault && answered.fault->fault == MachineFault::program_wrong;
  if (is_done || (is_refused && !is_resumed) || is_of_program) return JobEnd::over;
  if (!trouble) return JobEnd::interrupted;
  return *trouble == LinkError::no_answer ? JobEnd::board_silent : JobEnd::board_in_fault;
}

}  // namespace passo
