// The text of (DEBUG,…), (PRINT,…) and (LOG,…), in which #12 and #<name> are replaced by their values.
#pragma once

#include <string>
#include <string_view>

#include "passo/gcode/expression.hpp"
#include "passo/gcode/symbols.hpp"

namespace passo {

// Six decimals, or as %d (none), %f (four) or %.3f before them say, as LinuxCNC writes them; ###### where there is no
// such parameter.
void fill_in_parameters(std::string_view text, const ParameterValues& parameters, SymbolTable& symbols,
                        std::string& out);

}  // namespace passo
