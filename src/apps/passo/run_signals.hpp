// The signals that Ctrl-C and `kill` send to a command. A command that moves a board brakes first; any other command
// ends.
#pragma once

namespace passo {

// From now on a signal ends the program. Output files that were begun are removed.
void end_on_signals();
// From now on interrupted_by() reports the first signal, and a second signal ends the program.
void brake_on_signals();
// The signal's number; 0: no signal has come.
int interrupted_by();

}  // namespace passo
