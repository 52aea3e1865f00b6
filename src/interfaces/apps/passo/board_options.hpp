// `passo board` and its subcommands.
#pragma once

#include <functional>
#include <span>

#include "command_table.hpp"

namespace passo {

// Adds the examples to the help of `passo board`. Its options belong to the subcommands.
std::function<int()> add_board_help(CLI::App& board);
std::span<const Command> board_commands();

}  // namespace passo
