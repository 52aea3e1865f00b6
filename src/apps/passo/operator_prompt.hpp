// OperatorPrompt: asks a person on the terminal to do what the program waits for (M0, M1, M6), while the machine goes
// on being heard. ProgramStops: which of these a program has.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"

#include "passo/session/machine_session.hpp"

namespace passo {

// There is somebody to ask: standard input and error are a terminal.
bool asks_operator();
// "line 12: tool 2 (M6)".
std::string words_of(const OperatorWait& wait);

// Where nobody is asked, what a program would wait for is told before it runs.
class ProgramStops {
 public:
  // Each item of the path.
  void watch(const PathItem& item);
  // On standard error, unless there is none.
  void tell(const RunArguments& arguments) const;

 private:
  std::vector<OperatorWait> stops_;  // the first ones
  std::uint64_t count_ = 0;
};

class OperatorPrompt {
 public:
  explicit OperatorPrompt(std::string program) : program_(std::move(program)) {}
  // Before each turn: asks, where the program waits, and hears whether Enter was pressed. How long the turn may take.
  // Where nobody can be asked the program is stopped.
  Seconds look(MachineSession& session);
  bool gave_up() const { return fault_.has_value(); }
  const std::optional<ActivityFault>& fault() const { return fault_; }

 private:
  std::string program_;
  bool asked_ = false;
  std::optional<ActivityFault> fault_;
};

}  // namespace passo
