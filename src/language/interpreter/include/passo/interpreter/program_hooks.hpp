// ProgramHooks: lines of G-code of the machine file that run in each job: before its first line, and at M2 or M30.
#pragma once

#include <string>

namespace passo {

struct ProgramHooks {
  std::string at_start;  // lines, each with its end
  std::string at_end;

  bool empty() const { return at_start.empty() && at_end.empty(); }
};

}  // namespace passo
