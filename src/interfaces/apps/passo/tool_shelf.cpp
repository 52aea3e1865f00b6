#include "tool_shelf.hpp"

#include <utility>

#include "tool_warning_words.hpp"
#include <fmt/format.h>

namespace passo {

std::string mm_text(double mm) {
  return fmt::format("{:.10g}mm", mm);
}

bool is_tool_number(const std::string& text) {
  return text.starts_with('T') && parse_tool_number(text).has_value();
}

int ToolShelf::open(bool wants_tool) {
  const CamToolArguments& a = arguments_;
  if (a.tool_table.empty()) {
    if (wants_tool) return fail(exit_bad_program, "a tool number needs --tool-table FILE [tool.no-library]");
    if (!a.material.empty())
      return fail(exit_bad_program, "--material needs --tool-table FILE and a tool, e.g. T1 [tool.no-library]");
    return exit_done;
  }
  if (!wants_tool) {
    return fail(exit_bad_program,
                "--tool-table: expected a tool by its number in an option for a cutter, e.g. T1 [tool.none-chosen]");
  }
  Diagnostics findings;
  library_ = ToolLibrary::read(a.tool_table, findings);
  show(findings);
  if (!library_) return exit_bad_program;
  if (!a.material.empty()) material_ = work_material_of(a.material);
  if (a.limits.empty()) return exit_done;
  Diagnostics of_machine;
  const auto machine = load_machine_file(a.limits, of_machine, MachineUse::any_board);
  show(of_machine);
  if (!machine) return exit_bad_machine;
  limits_ = tool_limits_of(*machine);
  return exit_done;
}

const CuttingTool* ToolShelf::find(const char* option, const std::string& text) {
  if (!library_ || !is_tool_number(text)) return nullptr;
  const CuttingTool* const tool = library_->find(*parse_tool_number(text));
  if (tool == nullptr) {
    code_ = fail(exit_bad_program,
                 fmt::format("{}: expected one of {}, found '{}' [tool.unknown]", option, library_->numbers(), text));
  }
  return tool;
}

const CuttingTool* ToolShelf::find(const char* option, const std::string& text,
                                   std::initializer_list<CuttingShape> shapes) {
  const CuttingTool* const tool = find(option, text);
  if (tool == nullptr || std::ranges::find(shapes, tool->shape) != shapes.end()) return tool;
  std::string expected;
  for (const CuttingShape shape : shapes) {
    const bool is_last = shape == *(shapes.end() - 1);
    expected += (expected.empty() ? "" : is_last ? " or " : ", ") + std::string(name_of(shape));
  }
  code_ = fail(exit_bad_program, fmt::format("{}: expected a tool of shape {}, found {} [tool.wrong-shape]", option,
                                             expected, describe(*tool)));
  return nullptr;
}

std::optional<CuttingFeeds> ToolShelf::feeds(const CuttingTool& tool, FeedRequest request) const {
  if (!material_) return std::nullopt;
  request.material = *material_;
  request.spindle = limits_.spindle;
  request.most_feed = limits_.most_feed;
  request.most_plunge = limits_.most_plunge;
  return feeds_of(tool, request);
}

std::string ToolShelf::describe_use(const char* option, const CuttingTool& tool, const ToolUse& use) const {
  std::string words = fmt::format("{}: {}", option, describe(tool));
  const double per_turn = use.rpm > 0 ? use.feed.value() * seconds_per_minute / use.rpm : 0;
  if (material_ && per_turn > 0) {
    words += fmt::format("; {:.3g} mm per tooth in {}", per_turn / tool.flutes, name_of(*material_));
  }
  return words;
}

void ToolShelf::remark(const char* option, const CuttingTool& tool, const ToolUse& use) {
  arguments_.tool_remarks.push_back(describe_use(option, tool, use));
}

int ToolShelf::refuse(const std::string& message) {
  return code_ = fail(exit_bad_program, message);
}

void ToolShelf::judge(const CuttingTool& tool, const ToolUse& use) {
  for (const ToolWarning& warning : warnings_of(tool, use, material_, limits_.spindle, limits_.most_feed)) {
    findings_.add(finding_of(warning, library_->file()));
    warnings_.push_back(json_of(warning, tool.number));
  }
}

int ToolShelf::finish() {
  if (code_ != exit_done || !library_) return code_;
  show(findings_);
  arguments_.tool_warnings_json = warnings_.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  return exit_done;
}

void fill_in(std::string& option, const char* name, double mm, const IsGiven& is_given) {
  if (!is_given(name) && mm > 0) option = mm_text(mm);
}

double per_minute(MmPerSecond speed) {
  return speed.value() * seconds_per_minute;
}

// Along a ramp, a tool without centre teeth may descend with a part of its feed.
double descent_of(const CuttingFeeds& feeds) {
  constexpr double share = 0.25;
  return feeds.plunge > MmPerSecond(0) ? per_minute(feeds.plunge) : per_minute(feeds.feed) * share;
}

}  // namespace passo
