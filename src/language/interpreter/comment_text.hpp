// The text of (DEBUG,…), (PRINT,…) and (LOG,…), with #12 and #<name> replaced by their values.
#pragma once

#include <string>
#include <string_view>

#include "passo/gcode/expression.hpp"
#include "passo/gcode/symbols.hpp"

namespace passo {

// Values have six decimals, unless preceded by %d (none), %f (four) or %.3f, as in LinuxCNC. A parameter that does not
// exist becomes ######.
void fill_in_parameters(std::string_view text, const ParameterValues& parameters, SymbolTable& symbols,
                        std::string& out);

}  // namespace passo
