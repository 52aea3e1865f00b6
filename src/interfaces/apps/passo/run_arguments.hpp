// Whether the arguments of `passo run` fit together.
#pragma once

#include "commands.hpp"

namespace passo {

// An emulated board ends with the run, so its journal would be useless.
bool keeps_journal(const RunArguments& arguments);
// Whether the name of each picture and trace ends as it must, because the end of a name tells the kind of file. If not,
// shows a message.
bool names_are_good(const RunArguments& arguments);
// Whether the board can do what is asked of it. If not, shows a message.
bool suits_the_board(const RunArguments& arguments);

}  // namespace passo
