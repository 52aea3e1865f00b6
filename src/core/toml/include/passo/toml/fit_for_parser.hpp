// The work before and after TOML parsing, common to all TOML files written by users.
#pragma once

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/toml/toml_reporter.hpp"

namespace passo {

inline constexpr std::size_t most_sorted_errors = 1000;  // kept for sorting

// Rejects input that a parser should not see. Multi-line strings are rejected too: without them, a comment can be
// recognised from its line alone.
bool is_fit_for_parser(const TomlReporter& reporter);

// Sorts findings by line, because users correct a file from top to bottom, and adds them to `diagnostics`.
void hand_over(const Diagnostics& found, Diagnostics& diagnostics);

}  // namespace passo
