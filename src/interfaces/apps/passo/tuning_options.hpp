// The options of the commands that tune a machine.
#pragma once

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

void add_tune_options(CLI::App& command, TuneArguments& arguments);

}  // namespace passo
