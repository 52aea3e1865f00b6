// The readers of the formats. Private to tool_import/.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "json_source.hpp"
#include "tool_collector.hpp"

namespace passo {

inline constexpr double mm_in_inch = 25.4;

void read_fusion_tools(JsonSource& source, ToolCollector& tools);
// One tool bit (.fctb), or a library (.fctl), whose tool bits are read by options.read_tool_bit.
void read_freecad_tools(JsonSource& source, const ToolImportOptions& options, ToolCollector& tools);
void read_passo_tools(JsonSource& source, ToolCollector& tools);
// Returns false, with diagnostics, if it is not a tool table.
[[nodiscard]] bool read_linuxcnc_tools(std::string_view text, const std::string& file, const ToolImportOptions& options,
                                       ToolCollector& tools, std::vector<UnusedField>& unused,
                                       Diagnostics& diagnostics);

}  // namespace passo
