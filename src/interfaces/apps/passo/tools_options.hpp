// The options of `passo tools`.
#pragma once

#include <span>

#include "command_table.hpp"

namespace passo {

// The subcommands of `passo tools`.
std::span<const Command> tools_commands();

}  // namespace passo
