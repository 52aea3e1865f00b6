// The predefined #<_names>, which return the current state of the machine. Those of modes are in the rows of their
// codes; the others are one row of a table each.
#pragma once

#include <span>
#include <string_view>

#include "program_state.hpp"

namespace passo {

struct PredefinedParameter {
  std::string_view name;
  double (*of)(const ProgramState&) = nullptr;
  const CodeEntry* mode = nullptr;  // the value is 1 while this code is active

  double value(const ProgramState& state) const;
};

std::span<const PredefinedParameter> predefined_parameters();

}  // namespace passo
