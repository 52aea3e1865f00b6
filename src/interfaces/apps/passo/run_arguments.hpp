// Checks that the arguments of `passo run` are consistent.
#pragma once

#include "commands.hpp"

namespace passo {

// Returns whether the run keeps a journal. An emulated board ends with the run, so its journal would be useless.
bool keeps_journal(const RunArguments& arguments);
// Whether what tools cut is counted: on real machines, or if a file for it was given.
bool counts_tools(const RunArguments& arguments);
// Returns whether the name of each picture and trace has a valid extension, which determines the format. If not, shows
// a message.
bool names_are_good(const RunArguments& arguments);
// Returns whether the board supports the request. If not, shows a message.
bool suits_the_board(const RunArguments& arguments);

}  // namespace passo
