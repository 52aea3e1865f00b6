// OperatorPrompt: asks a person on the terminal to do what the program waits for (M0, M1, M6). Meanwhile the session
// still hears the machine. ProgramStops: the stops and tool changes of a program.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"

#include "passo/session/machine_session.hpp"

namespace passo {

// Whether somebody can be asked: standard input and standard error are a terminal.
bool asks_operator();
// "line 12: tool 2 (M6): 6 mm drill".
std::string describe(const OperatorWait& wait);

// The stops of a program, reported by a check, and before a run that asks nobody.
class ProgramStops {
 public:
  // Call the first for each operation, and the second for each item of the path.
  void watch(const Operation& operation, const ToolTable& tools) { words_.watch(operation, tools); }
  void watch(const PathItem& item);
  // All stops: count() is how many there are, words() names the first ones, and first() has them.
  std::uint64_t count() const { return count_; }
  std::string words() const;
  const std::vector<OperatorWait>& first() const { return stops_; }
  // Reports the stops on standard error, if there are any.
  void tell(const RunArguments& arguments) const;

 private:
  std::vector<OperatorWait> stops_;  // the first stops
  std::uint64_t count_ = 0;
  WaitWords words_;
};

class OperatorPrompt {
 public:
  explicit OperatorPrompt(std::string program) : program_(std::move(program)) {}
  // Call it before each turn. Asks when the program waits, and notices when Enter is pressed. Returns how long the turn
  // may take. If nobody can be asked, the program is stopped.
  Seconds poll(MachineSession& session);
  // The same for a machine without a session that rests at a stop: true when Enter was pressed. Takes 50 ms at most.
  bool hears_enter(const OperatorWait& wait);
  bool gave_up() const { return fault_.has_value(); }
  const std::optional<ActivityFault>& fault() const { return fault_; }

 private:
  std::string program_;
  bool asked_ = false;
  std::optional<ActivityFault> fault_;
};

}  // namespace passo
