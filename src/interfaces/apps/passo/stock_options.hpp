// The options for stock and tools, used by `passo simulate` and `passo check`.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace passo {

// The command-line arguments as text.
struct StockArguments {
  std::string block;                // "X0:100,Y0:80,Z-10:0"; missing axes are as the feed moves require
  std::optional<double> cell = {};  // mm
  std::vector<std::string> tools;   // "ball:3", "2=vee:60:6"
  std::string tool_table;           // TOML; empty: none
  std::vector<std::string> clamps;  // "X0:10,Y0:20,Z15"
};

void add_stock(CLI::App& command, StockArguments& arguments);

}  // namespace passo
