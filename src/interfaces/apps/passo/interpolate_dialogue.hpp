// The dialogue of `passo interpolate` without a move: it asks for the steps of motor 1, 2, … and prints the sequence of
// positions, a line for each pulse, with a tab after each number. The last line is the end of the move.
#pragma once

#include "commands.hpp"

namespace passo {

// The questions go to standard error, in the user's language (LC_ALL, LC_MESSAGES, LANG), so that standard output has
// only the sequence. An empty line or the end of the input ends the list. The lean method takes any number of motors,
// another one at most 8. Returns the exit code.
int interpolate_dialogue(const InterpolateArguments& arguments);

}  // namespace passo
