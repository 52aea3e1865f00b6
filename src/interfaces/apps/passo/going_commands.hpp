// passo frame and passo go: small programs that frame a job, and that go to a known place.
#pragma once

#include <string>

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

void add_frame_options(CLI::App& command, FrameArguments& arguments);
void add_go_options(CLI::App& command, GoArguments& arguments);

}  // namespace passo
