// passo frame, passo go and passo macro: small programs that frame a job, go to a known position, or are made from a
// macro.
#pragma once

#include <string>
#include <vector>

#include "commands.hpp"

#include "passo/activity/framing.hpp"
#include "passo/activity/go_to.hpp"

namespace CLI {
class App;
}

namespace passo {

struct FrameArguments {
  ProgramArguments program;
  std::string machine;
  Framing framing;
  bool machine_zero = false;  // accepts that no work zero is set
  std::string output;         // empty: standard output
};
int frame(const FrameArguments& arguments);

struct GoArguments {
  Destination destination = Destination::park;
  ProgramArguments files;  // for the parameter file; no program
  std::string machine;
  std::string output;  // empty: standard output
};
int go(const GoArguments& arguments);

struct MacroArguments {
  std::string macro;                // file
  std::vector<std::string> values;  // NAME=VALUE
  std::string output;               // empty: standard output
};
int macro(const MacroArguments& arguments);

void add_frame_options(CLI::App& command, FrameArguments& arguments);
void add_go_options(CLI::App& command, GoArguments& arguments);
void add_macro_options(CLI::App& command, MacroArguments& arguments);

}  // namespace passo
