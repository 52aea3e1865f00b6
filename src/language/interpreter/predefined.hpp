// The predefined #<_names>. They tell the present state of the machine. Each name is one line of a table.
#pragma once

#include <span>
#include <string_view>

#include "program_state.hpp"

namespace passo {

struct PredefinedParameter {
  std::string_view name;
  double (*value)(const ProgramState&);
};

std::span<const PredefinedParameter> predefined_parameters();

}  // namespace passo
