// The options of `passo board`, which has commands of its own.
#pragma once

#include <functional>

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

struct BoardArguments {
  BoardListArguments list;
  BoardInfoArguments info;
  BoardMonitorArguments monitor;
  BoardFlashArguments flash;
  BoardServeArguments serve;
  std::function<int()> chosen;  // the chosen command, after parsing
};

CLI::App& add_board_command(CLI::App& app, const std::vector<std::string>& words, BoardArguments& arguments);

}  // namespace passo
