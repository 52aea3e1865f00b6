// Our own JSON: {"format": "passo-tool-library", "version": 1, "units": "mm", "tools": [{"number": 1, "shape": …}]}.
//
// The members of a tool are the keys of [tool.N]. null: unknown.
#include <numbers>

#include "format_readers.hpp"
#include "tool_json_names.hpp"
#include <fmt/format.h>

#include "passo/tooling/tool_library.hpp"

namespace passo {
namespace {

using Json = JsonSource::Json;

void read_chip_loads(JsonSource& source, const Json& tool, ToolDraft& draft) {
  const Json* const loads = JsonSource::find(tool, "chip_load_mm");
  if (loads == nullptr || !loads->is_object()) return;
  if (loads->empty()) source.use(*loads);
  for (const std::string_view name : work_material_names()) {
    const auto load = source.number(*loads, std::string(name).c_str());
    if (load) draft.add_chip_load(*work_material_of(name), Mm(*load));
  }
}

void read_tool(JsonSource& source, const Json& tool, const std::string& place, ToolCollector& tools) {
  ToolDraft draft;
  for (const std::string_view key : tool_json_names) {
    const std::string name(key);
    const Json* const value = JsonSource::find(tool, name.c_str());
    if (value == nullptr) continue;
    if (value->is_null()) {
      source.use(*value);
    } else if (const auto number = source.number(tool, name.c_str())) {
      draft.set(key, *number);
    } else if (const auto flag = source.flag(tool, name.c_str())) {
      draft.set(key, *flag);
    } else if (const auto text = source.text(tool, name.c_str()); text && !(key == "name" && text->empty())) {
      draft.set_text(key, *text);
    }
  }
  read_chip_loads(source, tool, draft);
  const auto number = source.tool_number(tool, "number");
  if (!number) return tools.leave_out(place, "it has no whole number");
  tools.add(draft, *number, place);
}

}  // namespace

void read_passo_tools(JsonSource& source, ToolCollector& tools) {
  for (const char* const key : {"format", "units", "file"}) source.text(source.root(), key);
  source.number(source.root(), "version");
  const Json* const list = JsonSource::find(source.root(), "tools");
  if (list == nullptr || !list->is_array()) return;
  for (std::size_t i = 0; i < list->size() && !tools.is_full(); ++i) {
    read_tool(source, (*list)[i], fmt::format("/tools/{}", i), tools);
  }
}

}  // namespace passo
