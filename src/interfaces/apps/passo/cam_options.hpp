// The options of `passo cam`, which makes programs of drawings.
#pragma once

#include <span>

#include "cam_arguments.hpp"
#include "command_table.hpp"

namespace passo {

// Of the commands for circuit boards, whose options can be kept in a profile or remembered for a machine.
struct CamArguments {
  CamDrillArguments drill;
  CamIsolateArguments isolate;
  CamOutlineArguments outline;
  CamBoardArguments board;
  std::string machine;    // whose remembered options are used; empty: none are
  bool remember = false;  // the options that are given
};

// The commands of `passo cam`.
std::span<const Command> cam_commands();

void add_drill_options(CLI::App& drill, CamArguments& all);
void add_isolate_options(CLI::App& isolate, CamArguments& all);
void add_outline_options(CLI::App& outline, CamArguments& all);
void add_board_job_options(CLI::App& board, CamArguments& all);
void add_profile_options(CLI::App& profile, CamProfileArguments& arguments);
void add_pocket_options(CLI::App& pocket, CamPocketArguments& arguments);
void add_engrave_options(CLI::App& engrave, CamEngraveArguments& arguments);
void add_wire_options(CLI::App& wire, CamWireArguments& arguments);
void add_relief_options(CLI::App& relief, CamReliefArguments& arguments);

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
