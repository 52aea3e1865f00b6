// The commands of `passo cam`, which generate programs from drawings, and their options.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "cam_commands.hpp"
#include "command_table.hpp"

namespace passo {

// The arguments of the commands for circuit boards, whose options can be saved in a profile or for a machine.
struct CamArguments {
  CamDrillArguments drill;
  CamIsolateArguments isolate;
  CamOutlineArguments outline;
  CamBoardArguments board;
  std::string machine;    // the machine whose saved options are used; empty: none
  bool remember = false;  // whether to save the given options
  std::map<std::string, std::vector<std::string>> of_profile = {};  // options that a profile sets, by command
};

// The commands of `passo cam`.
std::span<const Command> cam_commands();

// Adds the options of an operation or a study, as its rows describe them, and its examples. Parsed values are stored in
// the members named by the rows.
void add_options(CLI::App& command, std::span<const CamOption> options);

// Adds the options of the study `tune`.
void add_tune_options(CLI::App& command, TuneArguments& arguments);

// Adds --machine and --remember, with which options are saved for a machine and supply the values that are not given.
void add_remember_options(CLI::App& command, CamArguments& arguments);
// Returns an exit code.
int use_remembered(const CLI::App& command, CamArguments& arguments);
// Does the same for the three commands of a board: from --profile, or from the saved options.
int read_profile(CamArguments& arguments);

}  // namespace passo
