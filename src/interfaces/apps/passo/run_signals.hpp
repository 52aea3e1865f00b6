// The signals that Ctrl-C, `kill` and a closed terminal send to a command. A command that moves a machine brakes first;
// any other command ends.
//
// A closed pipe (SIGPIPE) does not end a command that has called one of these functions: its next write fails. See
// flush_output().
#pragma once

namespace passo {

// From now on a signal ends the program, which has not moved anything yet. Unfinished output files are removed.
void end_on_signals();
// From now on interrupted_by() reports the first signal, and a second signal ends the program.
void brake_on_signals();
// For a command that moves nothing and ends itself on request: interrupted_by() reports the first signal, and a second
// signal ends the program.
void catch_signals();
// Returns the signal's number; 0: no signal has been received.
int interrupted_by();
// Returns the exit code of a command ended by a signal: 128 plus its number. If there was no signal, shows this as an
// error, so that no command ends silently.
int exit_of_signal();
// For a program without such signals: neither a closed pipe nor the file size limit ends it.
void outlive_readers();

}  // namespace passo
