// passo probe and passo level: ready programs of the probe, and programs on a surface that is not flat.
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
  bool holes = false;       // what is drilled is levelled too
  double clear = 1;         // mm: see LevelOptions
  double beside = 5;        // mm
  std::string zero;         // "X,Y": where the program's Z0 was set; empty: as the map says
  std::string output;       // empty: standard output
};
int level(const LevelArguments& arguments);

void add_probe_options(CLI::App& command, ProbeArguments& arguments);
void add_level_options(CLI::App& command, LevelArguments& arguments);

}  // namespace passo
