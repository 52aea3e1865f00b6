// Any bytes as a tool library (TOML): either it is refused, with places inside its lines, or each tool is sound.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "kit/require.hpp"

#include "passo/tooling/tool_library.hpp"

namespace passo {
namespace {

using test::require;

void check_tool(const CuttingTool& tool) {
  require(tool.number >= 0 && tool.number <= 99'999, "number");
  require(flaw_of(shape_of(tool)).empty(), "a tool that is not valid");
  require(tool.flutes >= 1 && tool.flutes <= 12, "flutes");
  require(tool.stick_out > Mm(0) || tool.holder_diameter == Mm(0), "a holder at an unknown height");
  require(!tool.most_rpm || std::isfinite(*tool.most_rpm), "speed");
  require(describe(tool).find_first_of("\n\r()") == std::string::npos, "words that end a comment");
  const Mm wide = diameter_at(tool, Mm(1));
  require(wide >= Mm(0) && wide <= tool.diameter, "wider than the tool");
}

void check_library(std::string_view text) {
  Diagnostics diagnostics;
  const auto library = ToolLibrary::parse(text, "fuzz.toml", diagnostics);
  require(library.has_value() == !diagnostics.any_error(), "refused without a word, or taken with an error");
  for (const Diagnostic& finding : diagnostics.all()) {
    require(finding.code.starts_with("tools.") && !finding.message.empty(), "a finding without words");
    require(finding.place.column == 0 || finding.text.empty() || finding.place.column - 1 <= finding.text.size(),
            "a finding outside its line");
    static_cast<void>(render(finding, true));
  }
  if (!library) return;
  require(!library->tools().empty(), "no tool");
  for (const CuttingTool& tool : library->tools()) {
    check_tool(tool);
    require(library->find(tool.number) == &tool, "a tool that is not found");
  }
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::check_library({reinterpret_cast<const char*>(data), size});
  return 0;
}
