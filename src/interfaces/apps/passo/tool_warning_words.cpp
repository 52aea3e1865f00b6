#include "tool_warning_words.hpp"

namespace passo {

Diagnostic finding_of(const ToolWarning& warning, const std::string& library) {
  return {.severity = Severity::warning,
          .code = warning.code,
          .file = library,
          .place = {},
          .message = warning.message,
          .expected = warning.advice,
          .text = {}};
}

nlohmann::ordered_json json_of(const ToolWarning& warning, std::int32_t tool) {
  return {{"code", warning.code},   {"tool", tool},           {"message", warning.message}, {"advice", warning.advice},
          {"found", warning.found}, {"limit", warning.limit}, {"unit", warning.unit}};
}

}  // namespace passo
