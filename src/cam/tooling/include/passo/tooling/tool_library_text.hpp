// The text of a tool library (tool_library.hpp), written from its tools. ToolLibrary::parse() reads it again.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "passo/tooling/cutting_tool.hpp"

namespace passo {

// A key of [tool.N] with its value, as it is written.
struct ToolEntry {
  std::string_view key;
  std::string value;
};
std::string toml_value(double value);  // with ten digits
std::string toml_value(bool value);
std::string toml_value(std::string_view text);
// Returns the keys of a tool in the order of the manual. What is unknown, or has its default value, is left out.
std::vector<ToolEntry> entries_of(const CuttingTool& tool);

// Returns one table [tool.N].
std::string tool_table_of(std::int32_t number, std::span<const ToolEntry> entries,
                          const std::map<WorkMaterial, Mm>& chip_loads);
// `head`: comment lines at the beginning, without '#'.
std::string tool_library_text(std::span<const CuttingTool> tools, std::string_view head = {});

// Rounds to the ten digits with which lengths and angles are written: 0.125 inches are 3.175 mm,
// not 3.1749999999999998.
double as_written(double value);

}  // namespace passo
