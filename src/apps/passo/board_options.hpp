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
  std::function<int()> chosen;  // what was asked for, after parsing
};

CLI::App& add_board_command(CLI::App& app, BoardArguments& arguments);

}  // namespace passo
