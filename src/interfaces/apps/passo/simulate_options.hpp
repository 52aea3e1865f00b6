// passo simulate: its arguments, and the options that only this command has.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

struct SimulateArguments {
  ProgramArguments program;
  std::string machine;  // the machine whose smoothed path is cut; empty: the programmed path
  StockArguments stock;
  std::vector<std::string> pictures;  // .svg or .png
  std::string stl;
  std::optional<std::size_t> stl_step;  // cells
  std::string compare;                  // a surface (.stl, .csv) or a program
  double tolerance = 0.02;              // mm, of the comparison
  unsigned threads = 0;                 // 0: one per processor
  // For a hot wire instead of tools.
  std::string wire;                   // its kerf, "1.2" or "1.6@100,1@200"; empty: no hot wire
  std::string span;                   // distance between the towers; required if U V move
  std::optional<std::size_t> slices;  // number of foam slices; nothing: as many as the taper requires
  bool json = false;
};
int simulate(const SimulateArguments& arguments);
// Does the same for a hot-wire program; arguments.wire describes the wire.
int simulate_wire(const SimulateArguments& arguments);

// Adds the options of `passo check` for cutting a piece of stock.
void add_cut(CLI::App& command, CheckArguments& arguments);
void add_simulate_options(CLI::App& command, SimulateArguments& arguments);

}  // namespace passo
