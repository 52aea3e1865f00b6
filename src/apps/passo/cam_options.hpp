// The options of `passo cam`, which makes programs of drawings.
#pragma once

#include <functional>

#include "cam_arguments.hpp"

namespace CLI {
class App;
}

namespace passo {

struct CamArguments {
  CamShowArguments show;
  CamDrillArguments drill;
  CamIsolateArguments isolate;
  CamOutlineArguments outline;
  CamBoardArguments board;
  CamReliefArguments relief;
  CamProfileArguments profile;
  CamPocketArguments pocket;
  CamEngraveArguments engrave;
  CamWireArguments wire;
  std::string machine;          // whose remembered options are used; empty: none are
  bool remember = false;        // the options that are given
  std::function<int()> chosen;  // the chosen command, after parsing
};

CLI::App& add_cam_command(CLI::App& app, const std::vector<std::string>& words, CamArguments& arguments);

// Add the commands to `cam`.
void add_drill_command(CLI::App& cam, const std::vector<std::string>& words, CamArguments& arguments);
void add_isolate_command(CLI::App& cam, const std::vector<std::string>& words, CamArguments& arguments);
void add_outline_command(CLI::App& cam, const std::vector<std::string>& words, CamArguments& arguments);
void add_cam_board_command(CLI::App& cam, const std::vector<std::string>& words, CamArguments& arguments);
void add_relief_command(CLI::App& cam, const std::vector<std::string>& words, CamArguments& arguments);
void add_profile_command(CLI::App& cam, const std::vector<std::string>& words, CamArguments& arguments);
void add_pocket_command(CLI::App& cam, const std::vector<std::string>& words, CamArguments& arguments);
void add_engrave_command(CLI::App& cam, const std::vector<std::string>& words, CamArguments& arguments);
void add_wire_command(CLI::App& cam, const std::vector<std::string>& words, CamArguments& arguments);

// Options that are kept for a machine: how they are asked for, and how what was not given is filled in with them.
void add_remember_options(CLI::App& command, CamArguments& arguments);
// Returns an exit code.
int use_remembered(const CLI::App& command, CamArguments& arguments);
// The same for the three commands of a board: from --profile, or as remembered.
int read_profile(CamArguments& arguments);

// The options that all milling of drawings has.
void add_mill_options(CLI::App& command, CamMillArguments& arguments);
// How the cutter goes around an edge: depths, tabs, ramps, leads.
void add_edge_options(CLI::App& command, CamOutlineArguments& arguments);

}  // namespace passo
