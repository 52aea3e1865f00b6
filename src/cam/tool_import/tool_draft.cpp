#include "tool_draft.hpp"

#include <fmt/format.h>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/tooling/tool_library.hpp"

namespace passo {

bool ToolDraft::set_name(std::string_view name) {
  constexpr std::size_t longest = 60;  // bytes
  std::string fitting;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    fitting += c == '(' ? '[' : c == ')' ? ']' : byte < 0x20U || byte == 0x7fU ? ' ' : c;
  }
  if (fitting.size() > longest) {
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(fitting[end]) & 0xC0U) == 0x80U) --end;  // not amid a character
    fitting.resize(end);
  }
  const bool fits = fitting == name;
  const std::size_t first = fitting.find_first_not_of(' ');
  if (first != std::string::npos) set_text("name", fitting.substr(first, fitting.find_last_not_of(' ') - first + 1));
  return fits;
}

Result<CuttingTool, std::string> ToolDraft::finish(std::int32_t number) const {
  Diagnostics findings;
  const auto library = ToolLibrary::parse(tool_table_of(number, entries_, chip_loads_), "", findings);
  if (library) return library->tools().front();
  const Diagnostic& first = findings.all().front();
  const std::string& expected = first.expected;
  return Failure{expected.empty() ? std::string(first.message)
                                  : fmt::format("{}; expected {}", first.message, expected)};
}

}  // namespace passo
