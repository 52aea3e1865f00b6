// The options of `passo pendant`.
#pragma once

#include <span>

#include "command_table.hpp"

namespace passo {

std::span<const Command> pendant_commands();

}  // namespace passo
