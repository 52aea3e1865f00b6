// Where the language's rules are written: each diagnostic names the chapter that it comes from.
//
// RS274/NGC is NIST IR 6556, "The NIST RS274NGC Interpreter - Version 3" (2000); what LinuxCNC added to the language is
// in its manual, whose chapters and headings are named as they are in version 2.9 (2.10 for G70 to G72); what is
// Passo's alone, in docs/gcode.md.
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

// "RS274/NGC 3.5.4, dwell": the chapter of the G or M code that the diagnostic points at, where its mistake is in how
// that code is used, else the chapter of its own code. Empty: the mistake is not one of the language.
std::string rule_of(const Diagnostic& diagnostic);

}  // namespace passo
