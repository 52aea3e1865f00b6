// The commands of `passo cam`, which make programs of drawings, and their options.
#pragma once

#include <span>

#include "cam_commands.hpp"
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

// The options of an operation or a study, as its rows describe them. The values that are given go where the rows
// say that they stand.
void add_options(CLI::App& command, std::span<const CamOption> options);

// Of the study `tune`.
void add_tune_options(CLI::App& command, TuneArguments& arguments);

// Options that are kept for a machine: how they are asked for, and how what was not given is filled in with them.
void add_remember_options(CLI::App& command, CamArguments& arguments);
// Returns an exit code.
int use_remembered(const CLI::App& command, CamArguments& arguments);
// The same for the three commands of a board: from --profile, or as remembered.
int read_profile(CamArguments& arguments);

}  // namespace passo
