// The options of `passo spindle`.
#pragma once

#include <span>

#include "command_table.hpp"

namespace passo {

std::span<const Command> spindle_commands();

}  // namespace passo
