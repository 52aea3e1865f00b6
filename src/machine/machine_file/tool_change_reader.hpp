// Reads [tool_change] of a machine file: how the machine changes and measures its tools.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "passo/interpreter/tool_change_plan.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// Call it when all axes are known. Returns null if there was an error. `end` is called with each table that was read.
std::shared_ptr<const ToolChangePlan> read_tool_change(const TomlEntry& entry, const std::vector<AxisDescription>& axes,
                                                       const TomlReporter& reporter,
                                                       const std::function<void(TableReader&)>& end);

}  // namespace passo
