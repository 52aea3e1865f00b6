// The text of (DEBUG,…), (PRINT,…) and (LOG,…), in which #12 and #<name> are replaced by their values.
#pragma once

#include <string>
#include <string_view>

#include "passo/gcode/expression.hpp"
#include "passo/gcode/symbols.hpp"

namespace passo {

// Values have six decimals, unless %d (none), %f (four) or %.3f before them says otherwise, as in LinuxCNC. A parameter
// that does not exist becomes ######.
void fill_in_parameters(std::string_view text, const ParameterValues& parameters, SymbolTable& symbols,
                        std::string& out);

}  // namespace passo
