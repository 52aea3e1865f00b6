// shown_place: the place of a finding as a person counts it: in characters, not in bytes. An editor that is told to go
// to column 7 goes to the seventh character.
#pragma once

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

// The place of the diagnostic with column and length in characters of UTF-8. Without the line's text it is unchanged.
SourcePlace shown_place(const Diagnostic& diagnostic);

}  // namespace passo
