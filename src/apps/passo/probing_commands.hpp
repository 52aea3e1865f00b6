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

CLI::App& add_probe_command(CLI::App& app, const std::vector<std::string>& words, ProbeArguments& arguments);
// `program`: adds the options of programs.
CLI::App& add_level_command(CLI::App& app, const std::vector<std::string>& words, LevelArguments& arguments);

}  // namespace passo
