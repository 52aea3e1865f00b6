// The result of a job's run, and the resulting treatment of its journal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/link/link.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

// The result of a request, and the reason.
struct Answered {
  Outcome outcome = Outcome::done;
  std::optional<ActivityFault> fault = {};
  std::optional<Refusal> refused = {};  // the request was rejected

  std::string message() const { return refused ? refused->message() : fault ? fault->message() : std::string(); }
};
// Returns the answer to a request. `changes`: the session's changes since the request. Without an answer among them,
// the request counts as stopped.
Answered answer_of(const std::vector<MachineChange>& changes, Ticket ticket);

enum class JobEnd : std::uint8_t {
  over,           // finished, failed, or did not start: the journal is removed
  interrupted,    // it can continue at the board's stop point, if the journal contains it
  board_silent,   // the stop point is unknown; it can continue if the board keeps its power
  board_in_fault  // the board has lost its position or its session, so the job cannot continue from there
};
// `trouble`: the board's error. `is_resumed`: the run was to continue an earlier job, which is kept if the run is
// rejected.
JobEnd end_of_run(const Answered& answered, std::optional<LinkError> trouble, bool is_resumed);

}  // namespace passo
