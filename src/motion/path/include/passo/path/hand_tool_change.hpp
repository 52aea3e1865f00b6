// HandToolChange: recognises a tool change by hand in a program without M6: a T word, or a comment that names the tool,
// and then M0 before the next feed. Programs for Grbl change tools this way, because M6 is an error there.
//
// The comments are those of `passo cam`: (tool 2: flat end, 5 mm), (MSG, tool 2: …) and (tool: T2 flat end, 5 mm). In a
// program that uses M6, a T word only selects the next tool, so M0 is then a stop like any other.
#pragma once

#include <cstdint>
#include <string_view>

#include "passo/interpreter/operation.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class HandToolChange {
 public:
  // Call it for each operation of the program, in order.
  void watch(const Operation& operation);

  // The tool that the operator inserts, if the program stops (M0) after the operations so far; 0: none.
  std::int32_t at_stop() const { return uses_m6_ ? 0 : next_; }
  // The tool that comments name before the first feed. It is in the spindle at the start, unless the program calls
  // another one; 0: none.
  std::int32_t at_start() const { return at_start_; }

 private:
  void name(std::int32_t tool);

  std::int32_t next_ = 0;
  std::int32_t at_start_ = 0;
  bool has_fed_ = false;
  bool uses_m6_ = false;
};

// The number in a comment that names a tool; 0: it names none.
std::int32_t tool_named_in(std::string_view comment);

// Whether the tool is `action.tool` after this action: M6, or M0 with the tool that is changed by hand (otherwise 0).
constexpr bool changes_tool(const Action& action) {
  return action.kind == Action::Kind::tool_change || (action.kind == Action::Kind::program_stop && action.tool != 0);
}

}  // namespace passo
