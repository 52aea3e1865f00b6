// What stands before and after a TOML parser, for each file in TOML that a user writes.
#pragma once

#include "toml_reporter.hpp"

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

inline constexpr std::size_t most_sorted_errors = 1000;  // kept, so that they can be sorted

// Refuses what a parser should not see. A text over several lines is refused too: without such texts a comment can be
// recognised from its line alone.
bool is_fit_for_parser(const TomlReporter& reporter);

// A file is checked by meaning, but a person corrects it from top to bottom: so sorts by line.
void hand_over(const Diagnostics& found, Diagnostics& diagnostics);

}  // namespace passo
