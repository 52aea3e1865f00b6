#include "tool_collector.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::int32_t largest_number = 99'999;
constexpr std::size_t most_notes = 10'000;

}  // namespace

void ToolCollector::leave_out(const std::string& place, std::string why) {
  if (imported_.left_out.size() < most_notes) imported_.left_out.push_back({place, std::move(why)});
}

void ToolCollector::note_change(const std::string& place, std::string what) {
  if (imported_.changed.size() < most_notes) imported_.changed.push_back({place, std::move(what)});
}

void ToolCollector::name(ToolDraft& draft, std::string_view name, const std::string& place) {
  if (draft.set_name(name)) return;
  note_change(place, "its name was changed, so that it fits into comments of programs");
}

void ToolCollector::add(const ToolDraft& draft, std::optional<std::int32_t> number, const std::string& place) {
  const bool has_number = number && *number >= 1 && *number <= largest_number;
  Result<CuttingTool, std::string> tool = draft.finish(has_number ? *number : 1);
  if (!tool) return leave_out(place, tool.error());
  if (has_number && tools_.emplace(*number, *tool).second) return;
  if (has_number) note_change(place, fmt::format("T{} is used already", *number));
  numberless_.emplace_back(std::move(*tool), place);
}

void ToolCollector::add_unused(const std::vector<UnusedField>& fields, const std::string& file) {
  for (const UnusedField& field : fields) {
    const auto known = std::ranges::find(imported_.unused, field.field, &UnusedField::field);
    if (known != imported_.unused.end()) {
      known->count += field.count;
    } else if (imported_.unused.size() < ImportedTools::most_fields) {
      imported_.unused.push_back({field.field, field.count, file + field.first});
    }
  }
}

ImportedTools ToolCollector::take() {
  std::int32_t next = tools_.empty() ? 1 : tools_.rbegin()->first + 1;
  if (next + static_cast<std::int32_t>(numberless_.size()) > largest_number) next = 1;
  for (auto& [tool, place] : numberless_) {
    while (tools_.contains(next)) ++next;
    tool.number = next;
    note_change(place, fmt::format("it got the free number T{}", next));
    tools_.emplace(next, std::move(tool));
  }
  for (auto& [number, tool] : tools_) imported_.tools.push_back(std::move(tool));
  return std::move(imported_);
}

}  // namespace passo
