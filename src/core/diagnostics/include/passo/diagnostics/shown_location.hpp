// shown_location: converts the position of a finding from bytes to characters, as editors count columns.
#pragma once

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

// Returns the diagnostic's position with column and length in UTF-8 characters. Without the line's text it is
// unchanged.
SourceLocation shown_location(const Diagnostic& diagnostic);

}  // namespace passo
