// OperatorPrompt: asks the operator on the terminal to do what the program waits for (M0, M1, M6). In the meantime the
// session keeps communicating with the machine.
#pragma once

#include <optional>
#include <string>

#include "commands.hpp"

#include "passo/judge/program_stops.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

// Returns whether prompts are possible: standard input and standard error are a terminal.
bool asks_operator();
// Reports the stops on standard error, if there are any.
void tell_stops(const ProgramStops& stops, const RunArguments& arguments);

class OperatorPrompt {
 public:
  explicit OperatorPrompt(std::string program) : program_(std::move(program)) {}
  // Must be called before each turn. Prompts when the program waits, and detects the Enter key. Returns the maximum
  // duration of the turn. If prompts are impossible, stops the program.
  Seconds poll(MachineSession& session);
  bool gave_up() const { return fault_.has_value(); }
  const std::optional<ActivityFault>& fault() const { return fault_; }

 private:
  Seconds poll_failed_spindle(MachineSession& session, const Sentence& fault);
  // Returns true when Enter was pressed. Takes at most 50 ms.
  bool hears_enter(const OperatorWait& wait);

  std::string program_;
  bool asked_ = false;
  std::optional<ActivityFault> fault_;
};

}  // namespace passo
