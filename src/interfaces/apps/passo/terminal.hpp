// What a stream of this process leads to: a terminal or a file, with colours or without, and how wide.
#pragma once

#include <cstddef>

namespace passo {

bool is_terminal(int descriptor);

// A terminal that understands escape sequences, so that a line on it can be rewritten. TERM=dumb says that it does not.
bool rewrites_lines(int descriptor);

// The text may have colours. A user switches them off with NO_COLOR (https://no-color.org) or TERM=dumb.
bool shows_colours(int descriptor);

// The width of the terminal now, in characters; it changes when the user resizes the window. 0: not known.
std::size_t columns_of(int descriptor);

}  // namespace passo
