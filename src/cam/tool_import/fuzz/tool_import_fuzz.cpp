// Any bytes as a tool library of another program: either it is refused with a finding, or each tool is sound, has its
// own number, and survives the way through our own files.
#include <cstdint>
#include <string>
#include <string_view>

#include "kit/require.hpp"

#include "passo/tool_import/tool_import.hpp"
#include "passo/tooling/tool_library.hpp"
#include "passo/tooling/tool_library_text.hpp"

namespace passo {
namespace {

using test::require;

void check_tools(const ImportedTools& imported) {
  std::int32_t last = -1;
  for (const CuttingTool& tool : imported.tools) {
    require(tool.number > last && tool.number <= 99'999, "numbers that do not ascend");
    last = tool.number;
    require(flaw_of(shape_of(tool)).empty(), "a tool that is not valid");
    require(describe(tool).find_first_of("\n\r()") == std::string::npos, "words that end a comment");
  }
  for (const UnusedField& field : imported.unused) require(field.count > 0 && !field.first.empty(), "an empty field");
  for (const ToolImportNote& note : imported.left_out) require(!note.text.empty(), "left out without a reason");
}

void check_ways(const ImportedTools& imported) {
  if (imported.tools.empty()) return;
  const std::string text = tool_library_text(imported.tools);
  Diagnostics findings;
  const auto library = ToolLibrary::parse(text, "written.toml", findings);
  require(library.has_value(), "a library that its own reader refuses");
  require(tool_library_text(library->tools()) == text, "another text the second time");
  const auto again = import_tools(tool_library_json(library->tools()), "t.json", {}, findings);
  require(again && again->left_out.empty() && tool_library_text(again->tools) == text, "JSON that loses something");
  static_cast<void>(linuxcnc_tool_table(library->tools(), LengthUnits::inch));
}

// The first byte selects the options. A library's tool bits are what follows its first line.
void check_import(std::string_view bytes) {
  if (bytes.empty()) return;
  const auto choice = static_cast<unsigned char>(bytes.front());
  bytes.remove_prefix(1);
  ToolImportOptions options;
  if ((choice & 1U) != 0) options.units = (choice & 2U) != 0 ? LengthUnits::inch : LengthUnits::mm;
  if ((choice & 4U) != 0) options.shape = CuttingShape::flat;
  options.read_tool_bit = [bytes](const std::string& name) -> std::optional<std::string> {
    require(name.find('/') == std::string::npos, "a name that leads elsewhere");
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    return std::string(bytes.substr(end));
  };
  std::string_view library = bytes;
  if ((choice & 8U) != 0) library = bytes.substr(0, bytes.find('\n'));
  Diagnostics findings;
  const auto imported = import_tools(library, "fuzz", options, findings);
  require(imported.has_value() == !findings.any_error(), "refused without a word, or taken with an error");
  for (const Diagnostic& finding : findings.all()) {
    require(!finding.code.empty() && !finding.message.empty(), "a finding without words");
    require(finding.place.column == 0 || finding.text.empty() || finding.place.column - 1 <= finding.text.size(),
            "a finding outside its line");
    static_cast<void>(render(finding, true));
  }
  if (!imported) return;
  check_tools(*imported);
  check_ways(*imported);
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::check_import({reinterpret_cast<const char*>(data), size});
  return 0;
}
