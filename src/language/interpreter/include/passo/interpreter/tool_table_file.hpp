// Reads a tool table in LinuxCNC's format, one tool per line:
//
//     T1 P1 D0.125 Z+0.511 ; 1/8 end mill
//
// T is the tool's number and P its pocket. The following words may be in any order: X Y Z A B C U V W, the offsets; D,
// the diameter; I and J, the front and back angle of a lathe tool; Q, its orientation. Text after ';' is a comment.
// Empty lines are skipped.
#pragma once

#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {

// Returns false if the file has errors, all of which are in `diagnostics`. `units`: the units of the file's lengths.
[[nodiscard]] bool read_tool_table(const std::string& path, LengthUnits units, ToolTable& table,
                                   Diagnostics& diagnostics);

// The same for a text that was read already. The name of `table` is that of the reader.
[[nodiscard]] bool read_tool_table(ProgramReader reader, LengthUnits units, ToolTable& table, Diagnostics& diagnostics);

// Returns `text`, the contents of such a file, with the tools updated from `table`. Changed numbers are replaced,
// missing words are appended to the others. Order, comments and all other lines are preserved.
std::string tool_table_text(std::string_view text, LengthUnits units, const ToolTable& table);
// Appends a line to `text` for each tool of `table` that is missing in `known`, the tools of the text.
void add_new_tools(std::string& text, const ToolTable& known, const ToolTable& table);
// Returns the contents of a file with these tools, in mm.
std::string tool_table_text(const ToolTable& table);

}  // namespace passo
