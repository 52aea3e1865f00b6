// passo probe and passo level: ready-made probing programs, and auto-levelling of programs.
#pragma once

#include <string>

#include "commands.hpp"

#include "passo/probing/probing_cycle.hpp"

namespace CLI {
class App;
}

namespace passo {

struct ProbeArguments {
  ProbingCycle cycle;
  std::string output;  // empty: standard output
};
int probe(const ProbeArguments& arguments);

struct LevelArguments {
  ProgramArguments program;  // no name: the map is shown
  std::string map;
  double tolerance = 0.01;  // mm
  bool holes = false;       // levels drilling, too
  double clear = 1;         // mm: see LevelOptions
  double beside = 5;        // mm
  std::string zero;         // "X,Y": where the program's Z0 was set; empty: as in the map
  std::string output;       // empty: standard output
};
int level(const LevelArguments& arguments);

void add_probe_options(CLI::App& command, ProbeArguments& arguments);
void add_level_options(CLI::App& command, LevelArguments& arguments);

}  // namespace passo
