// Reads a tool table in LinuxCNC's form, one tool a line:
//
//     T1 P1 D0.125 Z+0.511 ; 1/8 end mill
//
// T is the tool's number and P its pocket. Then come, in any order: X Y Z A B C U V W, the offsets; D, the diameter; I
// and J, the front and back angle of a lathe tool; Q, its orientation. Text after ';' is a remark. Empty lines are
// skipped.
#pragma once

#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

// False: something is wrong with the file. `diagnostics` has all of it. `units`: the units of the file's lengths.
[[nodiscard]] bool read_tool_table(const std::string& path, LengthUnits units, ToolTable& table,
                                   Diagnostics& diagnostics);

// Returns `text`, the text of such a file, with its tools as they are now in `table`. Numbers that differ are written
// anew. Words that were missing are written after the others. Order, remarks and all other lines stay.
std::string tool_table_text(std::string_view text, LengthUnits units, const ToolTable& table);
// Adds a line to `text` for each tool of `table` that `known`, the tools of the text, lacks.
void add_new_tools(std::string& text, const ToolTable& known, const ToolTable& table);
// The text of a file with these tools, in mm.
std::string tool_table_text(const ToolTable& table);

}  // namespace passo
