// What becomes of a job, and so of its journal, when its run has ended.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/link/link.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

// The result of a request that has been answered, and the reason.
struct Answered {
  Outcome outcome = Outcome::done;
  std::optional<ActivityFault> fault = {};
  std::optional<Refusal> refused = {};  // it never began

  std::string message() const { return refused ? refused->message() : fault ? fault->message() : std::string(); }
};
// `changes`: those of the session since the request. Without an answer among them the request was stopped.
Answered answer_of(const std::vector<MachineChange>& changes, Ticket ticket);

enum class JobEnd : std::uint8_t {
  over,           // it has come to its end, is wrong, or did not begin: the journal goes
  interrupted,    // it can continue at the board's stop point, if the journal contains it
  board_silent,   // the stop point is unknown; it can continue if the board keeps its power
  board_in_fault  // the board has lost its place or its session, so it cannot go on from there
};
// `trouble`: of the board. `is_resumed`: the run was to go on with an earlier job, which stays if the run is refused.
JobEnd end_of_run(const Answered& answered, std::optional<LinkError> trouble, bool is_resumed);

}  // namespace passo
