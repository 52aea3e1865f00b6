// The sources of the language's rules: each diagnostic names the chapter on which it is based.
//
// RS274/NGC is NIST IR 6556, "The NIST RS274NGC Interpreter - Version 3" (2000). LinuxCNC's additions are in its
// manual, whose chapters and headings are named as in version 2.9 (2.10 for G70 to G72). Passo's additions are in
// docs/gcode.md.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

// The rule on which a diagnostic code is based.
struct Rule {
  std::string_view code;
  std::string_view chapter;
};

// Returns all rules, sorted by code.
std::span<const Rule> rules();

// Returns the chapter for a diagnostic, e.g. "RS274/NGC 3.5.4, dwell". For an error in the use of a G or M code, it is
// the chapter of that code; otherwise the chapter of the diagnostic's own code. Empty if the error is not about the
// language.
std::string rule_of(const Diagnostic& diagnostic);

}  // namespace passo
