// The properties of a stream of this process: whether it is a terminal, supports colours, and how wide it is.
#pragma once

#include <cstddef>

namespace passo {

bool is_terminal(int descriptor);

// Returns whether the stream is a terminal with escape sequences, so that a line on it can be rewritten. TERM=dumb
// disables this.
bool rewrites_lines(int descriptor);

// Returns whether the text may be coloured. Users disable colours with NO_COLOR (https://no-color.org) or TERM=dumb.
bool shows_colours(int descriptor);

// Returns the current width of the terminal in characters; it changes when the window is resized. 0: unknown.
std::size_t columns_of(int descriptor);

}  // namespace passo
