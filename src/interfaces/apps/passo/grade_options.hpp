// The options of `passo grade`.
#pragma once

#include <span>

#include "command_table.hpp"

namespace passo {

// The subcommands of `passo grade`.
std::span<const Command> grade_commands();

}  // namespace passo
