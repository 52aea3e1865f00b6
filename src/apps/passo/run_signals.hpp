// Signals to a command at work: Ctrl-C ends it; or, where a board moves, brakes first.
#pragma once

namespace passo {

// What output was begun is removed.
void end_on_signals();
// The first one is for who asks interrupted_by(); a second one ends.
void brake_on_signals();
// Its number; 0: none has come.
int interrupted_by();

}  // namespace passo
