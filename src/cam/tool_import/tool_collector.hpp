// ToolCollector: the tools of an import, each with a number of its own. Private to tool_import/.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tool_draft.hpp"

#include "passo/tool_import/tool_import.hpp"

namespace passo {

class ToolCollector {
 public:
  explicit ToolCollector(ToolFileFormat format) { imported_.format = format; }

  // Adds the tool, or lists why it is left out. Without a number, or with one that is taken, it gets a free number at
  // the end.
  void add(const ToolDraft& draft, std::optional<std::int32_t> number, const std::string& place);
  void leave_out(const std::string& place, std::string why);
  void note_change(const std::string& place, std::string what);
  // Sets the name of a tool, and notes if it had to be changed.
  void name(ToolDraft& draft, std::string_view name, const std::string& place);
  // Adds the unused fields of a file that belongs to the library.
  void add_unused(const std::vector<UnusedField>& fields, const std::string& file);
  // No further tools are added.
  bool is_full() const { return tools_.size() + numberless_.size() >= ImportedTools::most_tools; }
  ImportedTools take();

 private:
  ImportedTools imported_;
  std::map<std::int32_t, CuttingTool> tools_;
  std::vector<std::pair<CuttingTool, std::string>> numberless_;  // with their places
};

}  // namespace passo
