// Reads [tool_change] of a machine file: how the machine changes and measures its tools.
#pragma once

#include <memory>

#include "passo/interpreter/tool_change_plan.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// Call it when all axes are known. Returns null if there was an error. `rack`: the table [tool_change.rack], or null.
// `macro`: the value of the key macro, or null.
std::shared_ptr<const ToolChangePlan> read_tool_change(TableReader& reader, TableReader* rack, const TomlValue* macro,
                                                       const std::vector<AxisDescription>& axes);

}  // namespace passo
