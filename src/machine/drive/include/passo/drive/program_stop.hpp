// is_program_stop(action): whether a program waits there for the operator, if it waits for operators at all: M0, M1,
// M6, unless the machine has changed the tool by itself.
#pragma once

#include "passo/path/segment.hpp"

namespace passo {

constexpr bool is_program_stop(const Action& action) {
  using Kind = Action::Kind;
  if (action.by_machine) return false;
  return action.kind == Kind::program_stop || action.kind == Kind::optional_stop || action.kind == Kind::tool_change;
}

}  // namespace passo
