// The signals that Ctrl-C, `kill` and a terminal that is closed send to a command. A command that moves a machine
// brakes first; any other command ends.
//
// A reader that goes away (SIGPIPE) ends no command that has called one of these functions: its next write fails. See
// flush_output().
#pragma once

namespace passo {

// From now on a signal ends the program, which has moved nothing yet. Output files that were begun are removed.
void end_on_signals();
// From now on interrupted_by() reports the first signal, and a second signal ends the program.
void brake_on_signals();
// For a command that moves nothing and ends by itself when it is told to: interrupted_by() reports the first signal,
// and a second signal ends the program.
void catch_signals();
// The signal's number; 0: no signal has come.
int interrupted_by();
// What a command returns that a signal has ended: 128 and its number. If no signal has come, shows that as an error, so
// that no command ends without a word.
int exit_of_signal();
// For a program without such signals: a reader that goes away is no reason to end, and a file that may not grow is
// none.
void outlive_readers();

}  // namespace passo
