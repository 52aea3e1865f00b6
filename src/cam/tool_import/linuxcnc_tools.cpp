// LinuxCNC's tool table: numbers, diameters and remarks. It has neither units nor shapes.
#include <algorithm>
#include <array>
#include <map>

#include "format_readers.hpp"
#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/interpreter/tool_table_file.hpp"

namespace passo {
namespace {

// Counts what the library has no place for.
class UnusedWords {
 public:
  void count(std::string_view word, bool is_used, std::int32_t tool) {
    if (!is_used) return;
    auto& field = fields_[std::string(word)];
    if (field.count++ == 0) field.first = fmt::format("T{}", tool);
    field.field = word;
  }
  void add_to(std::vector<UnusedField>& all) {
    for (auto& [word, field] : fields_) all.push_back(std::move(field));
  }

 private:
  std::map<std::string, UnusedField> fields_;
};

}  // namespace

bool read_linuxcnc_tools(std::string_view text, const std::string& file, const ToolImportOptions& options,
                         ToolCollector& tools, std::vector<UnusedField>& unused, Diagnostics& diagnostics) {
  if (!options.units) {
    diagnostics.add(of_file("tool-import.no-units", file, "a tool table of LinuxCNC does not state its units",
                            "--units mm or --units inch, as LINEAR_UNITS in the machine's ini file"));
    return false;
  }
  ToolTable table;
  if (!read_tool_table(ProgramReader::from_text(file, std::string(text)), *options.units, table, diagnostics)) {
    return false;
  }
  UnusedWords words;
  for (const auto& [number, tool] : table.all()) {
    const std::string place = fmt::format("T{}", number);
    words.count("P", tool.pocket != number, number);
    for (const Axis axis : all_axes) {
      words.count(std::string(1, letter_of(axis)), tool.offset[axis] != 0, number);
    }
    words.count("I", tool.front_angle_deg != 0, number);
    words.count("J", tool.back_angle_deg != 0, number);
    words.count("Q", tool.orientation != 0, number);
    if (!options.shape) {
      tools.leave_out(place, "a tool table has no shapes: give --shape");
      continue;
    }
    ToolDraft draft;
    draft.set_shape(*options.shape);
    draft.set("diameter_mm", std::abs(tool.diameter.value()));
    const auto remark = table.remarks.find(number);
    if (remark != table.remarks.end()) tools.name(draft, remark->second, place);
    tools.add(draft, number, place);
  }
  words.add_to(unused);
  return true;
}

}  // namespace passo
