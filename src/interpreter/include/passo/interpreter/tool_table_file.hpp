// Reading a tool table in LinuxCNC's form, a tool a line:
//
//     T1 P1 D0.125 Z+0.511 ; 1/8 end mill
//
// T the tool's number and P its pocket, then in any order: X Y Z A B C U V W its offsets, D its diameter, I and J front
// and back angle and Q the orientation of a lathe tool. What follows ';' is a remark. Empty lines are skipped.
#pragma once

#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

// False when something is wrong with the file; all of it is in `diagnostics`. `units`: of its lengths.
[[nodiscard]] bool read_tool_table(const std::string& path, LengthUnits units, ToolTable& table,
                                   Diagnostics& diagnostics);

// `text`, that of such a file, with its tools as they are in `table` now: numbers that differ are written anew, words
// that were not there behind the others. Order, remarks and all other lines stay.
std::string tool_table_text(std::string_view text, LengthUnits units, const ToolTable& table);

}  // namespace passo
