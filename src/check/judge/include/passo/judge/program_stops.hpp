// ProgramStops: where a program stops for the operator (M0, M1, M6), for a check, and before a run without prompts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/activity/operator_messages.hpp"
#include "passo/path/segment.hpp"
#include "passo/session/machine_status.hpp"

namespace passo {

// Returns e.g. "line 12: tool 2 (M6): 6 mm drill".
std::string describe(const OperatorWait& wait);

class ProgramStops {
 public:
  // The first must be called for each operation, the second for each item of the path.
  void watch(const Operation& operation, const ToolTable& tools) { words_.watch(operation, tools); }
  void watch(const PathItem& item);
  // All stops: count() is their number, words() names the first ones, and first() returns them.
  std::uint64_t count() const { return count_; }
  std::string words() const;
  const std::vector<OperatorWait>& first() const { return stops_; }

 private:
  std::vector<OperatorWait> stops_;  // the first stops
  std::uint64_t count_ = 0;
  OperatorMessages words_;
};

}  // namespace passo
