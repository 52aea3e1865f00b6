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
  std::string machine;  // its smoothed path is cut; empty: the path as the program has it
  StockArguments stock;
  std::vector<std::string> pictures;  // .svg or .png
  std::string stl;
  std::optional<std::size_t> stl_step;  // cells
  std::string compare;                  // a surface (.stl, .csv) or a program
  double tolerance = 0.02;              // mm, of the comparison
  unsigned threads = 0;                 // 0: one for each processor
  // A hot wire in the place of tools.
  std::string wire;                   // its kerf, "1.2" or "1.6@100,1@200"; empty: there is none
  std::string span;                   // from tower to tower; needed where U V move
  std::optional<std::size_t> slices;  // of the foam; nothing: as many as its taper needs
  bool json = false;
};
int simulate(const SimulateArguments& arguments);
// The same of a program for a hot wire, which arguments.wire describes.
int simulate_wire(const SimulateArguments& arguments);

// The options of `passo check` that cut a piece of stock.
void add_cut(CLI::App& command, CheckArguments& arguments);
void add_simulate_options(CLI::App& command, SimulateArguments& arguments);

}  // namespace passo
