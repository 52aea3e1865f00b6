// Where the language's rules are written: each diagnostic names the chapter that it comes from.
//
// RS274/NGC is NIST IR 6556, "The NIST RS274NGC Interpreter - Version 3" (2000). What LinuxCNC added to the language is
// in its manual. The manual's chapters and headings are named as in version 2.9 (2.10 for G70 to G72). What only Passo
// has is in docs/gcode.md.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

// The rule that a diagnostic's code comes from.
struct Rule {
  std::string_view code;
  std::string_view chapter;
};

// All rules, sorted by code.
std::span<const Rule> rules();

// The chapter of a diagnostic, as "RS274/NGC 3.5.4, dwell". If the mistake is in how a G or M code is used, it is the
// chapter of the G or M code that the diagnostic points at. Otherwise it is the chapter of the diagnostic's own code.
// Empty: the mistake is not one of the language.
std::string rule_of(const Diagnostic& diagnostic);

}  // namespace passo
