// The options of the commands that tune a machine.
#pragma once

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

CLI::App& add_tune_command(CLI::App& app, const std::vector<std::string>& words, TuneArguments& arguments);

}  // namespace passo
