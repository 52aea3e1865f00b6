#include "tools_api.hpp"

#include <set>

#include "api_answers.hpp"
#include "api_json.hpp"

#include "passo/job/tool_records.hpp"
#include "passo/tooling/tool_library.hpp"

namespace passo {
namespace {

constexpr std::uint64_t largest_tool = 99'999;

Json known(double value) {
  return value > 0 ? Json(rounded(value)) : Json();
}

}  // namespace

// The tools that the library, the tool table or the records know.
Json ToolsApi::tools() const {
  const ApiOptions& options = shared_.options;
  const ToolTable& table = shared_.programs.tools();
  std::map<std::int32_t, ToolRecord> records;
  std::set<std::int32_t> numbers;
  if (options.workshop.records != nullptr) {
    for (const ToolRecord& record : options.workshop.records->all()) records[record.tool] = record;
  }
  for (const auto& [number, record] : records) numbers.insert(number);
  // Without a table, the interpreter has example tools, which nobody owns.
  const bool has_table = !table.name.empty();
  if (has_table) {
    for (const auto& [number, tool] : table.all()) numbers.insert(number);
  }
  if (options.workshop.library != nullptr) {
    for (const CuttingTool& tool : options.workshop.library->tools()) numbers.insert(tool.number);
  }
  Json all = Json::array();
  for (const std::int32_t number : numbers) {
    const CuttingTool* const tool =
        options.workshop.library != nullptr ? options.workshop.library->find(number) : nullptr;
    const Tool* const entry = has_table ? table.find(number) : nullptr;
    const ToolRecord record = records.contains(number) ? records.at(number) : ToolRecord();
    const auto remark = table.remarks.find(number);
    const bool has_remark = has_table && remark != table.remarks.end();
    all.push_back({{"number", number},
                   {"name", tool != nullptr ? describe_without_number(*tool)
                            : has_remark    ? remark->second
                                            : std::string()},
                   {"pocket", entry != nullptr ? Json(entry->pocket) : Json()},
                   {"length_mm", entry != nullptr ? Json(rounded(entry->offset[Axis::z])) : Json()},
                   {"cut_mm", rounded(record.cut.length.value())},
                   {"cut_s", rounded(record.cut.time.value())},
                   {"life_mm", tool != nullptr ? known(tool->life.length.value()) : Json()},
                   {"life_s", tool != nullptr ? known(tool->life.time.value()) : Json()},
                   {"replaced_at", record.replaced_at > 0 ? Json(record.replaced_at) : Json()}});
  }
  return all;
}

WebAnswer ToolsApi::list(const ApiCall& /*call*/) {
  const bool counts = shared_.options.workshop.records != nullptr;
  return json_answer(200, {{"counts", counts}, {"tools", tools()}});
}

WebAnswer ToolsApi::replace(const ApiCall& call) {
  ToolRecords* const records = shared_.options.workshop.records;
  if (records == nullptr) {
    return error_answer(404, "tools.not-counted", "what tools cut is not counted: start passo serve with --data");
  }
  if (call.id == 0 || call.id > largest_tool) return error_answer(404, "http.not-found", "there is no such tool");
  if (!records->replace(static_cast<std::int32_t>(call.id), shared_.wall_time())) {
    return unwritten("the tool", "tool", records->trouble());
  }
  // Checks have told what was left of the old tool. That of a running job has its path, for viewers.
  if (!shared_.session.busy() && !shared_.programs.checks()) shared_.programs.forget_checks();
  return json_answer(200, {{"counts", true}, {"tools", tools()}});
}

}  // namespace passo
