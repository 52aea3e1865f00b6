// A warning about the use of a tool, as a finding and as JSON.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/tooling/tool_warnings.hpp"

namespace passo {

// `library`: the file of the tool.
Diagnostic finding_of(const ToolWarning& warning, const std::string& library);
nlohmann::ordered_json json_of(const ToolWarning& warning, std::int32_t tool);

}  // namespace passo
