// The predefined #<_names>. They tell the present state of the machine. Those of the modes stand in
// the rows of their codes; the others are one line of a table each.
#pragma once

#include <span>
#include <string_view>

#include "program_state.hpp"

namespace passo {

struct PredefinedParameter {
  std::string_view name;
  double (*of)(const ProgramState&) = nullptr;
  const CodeEntry* mode = nullptr;  // the value is whether this code is active

  double value(const ProgramState& state) const;
};

std::span<const PredefinedParameter> predefined_parameters();

}  // namespace passo
