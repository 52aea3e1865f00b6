// `passo board` and its commands.
#pragma once

#include <functional>
#include <span>

#include "command_table.hpp"

namespace passo {

// The examples of its help. Its commands have the options.
std::function<int()> add_board_help(CLI::App& board);
std::span<const Command> board_commands();

}  // namespace passo
