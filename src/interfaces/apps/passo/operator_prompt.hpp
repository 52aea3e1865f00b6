// OperatorPrompt: asks the operator on the terminal to do what the program waits for (M0, M1, M6). In the meantime the
// session keeps communicating with the machine. ProgramStops: the stops and tool changes of a program.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"

#include "passo/session/machine_session.hpp"

namespace passo {

// Returns whether prompts are possible: standard input and standard error are a terminal.
bool asks_operator();
// Returns e.g. "line 12: tool 2 (M6): 6 mm drill".
std::string describe(const OperatorWait& wait);

// The stops of a program, reported by a check, and before a run without prompts.
class ProgramStops {
 public:
  // The first must be called for each operation, the second for each item of the path.
  void watch(const Operation& operation, const ToolTable& tools) { words_.watch(operation, tools); }
  void watch(const PathItem& item);
  // All stops: count() is their number, words() names the first ones, and first() returns them.
  std::uint64_t count() const { return count_; }
  std::string words() const;
  const std::vector<OperatorWait>& first() const { return stops_; }
  // Reports the stops on standard error, if there are any.
  void tell(const RunArguments& arguments) const;

 private:
  std::vector<OperatorWait> stops_;  // the first stops
  std::uint64_t count_ = 0;
  OperatorMessages words_;
};

class OperatorPrompt {
 public:
  explicit OperatorPrompt(std::string program) : program_(std::move(program)) {}
  // Must be called before each turn. Prompts when the program waits, and detects the Enter key. Returns the maximum
  // duration of the turn. If prompts are impossible, stops the program.
  Seconds poll(MachineSession& session);
  // Does the same for a machine without a session that has stopped: returns true when Enter was pressed. Takes at most
  // 50 ms.
  bool hears_enter(const OperatorWait& wait);
  bool gave_up() const { return fault_.has_value(); }
  const std::optional<ActivityFault>& fault() const { return fault_; }

 private:
  std::string program_;
  bool asked_ = false;
  std::optional<ActivityFault> fault_;
};

}  // namespace passo
