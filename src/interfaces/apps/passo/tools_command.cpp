#include "tools_command.hpp"

#include <cstdio>

#include "commands.hpp"
#include "program_input.hpp"
#include "tool_limits.hpp"
#include "tool_warning_words.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "passo/tool_import/tool_import.hpp"
#include "passo/tooling/cutting_feeds.hpp"
#include "passo/tooling/tool_library.hpp"
#include "passo/tooling/tool_warnings.hpp"

namespace passo {
namespace {

using ToolsJson = nlohmann::ordered_json;

std::optional<ToolLibrary> shown_library(const std::string& path) {
  Diagnostics findings;
  auto library = ToolLibrary::read(path, findings);
  show(findings);
  return library;
}

int print_tools_json(const ToolsJson& json) {
  fmt::print("{}\n", json.dump(2, ' ', false, ToolsJson::error_handler_t::replace));
  return flush_output();
}

ToolsJson known_length(Mm length) {
  return length > Mm(0) ? ToolsJson(length.value()) : ToolsJson();
}

std::string length_cell(Mm length) {
  return length > Mm(0) ? fmt::format("{:g}", length.value()) : "-";
}

double speed_per_minute(MmPerSecond speed) {
  return speed.value() * seconds_per_minute;
}

ToolsJson json_of(const CuttingTool& tool, WorkMaterial material, const CuttingFeeds& feeds) {
  ToolsJson json = {
      {"tool", tool.number},
      {"description", describe(tool)},
      {"material", name_of(material)},
      {"rpm", feeds.rpm},
      {"feed_mm_min", speed_per_minute(feeds.feed)},
      {"plunge_mm_min", feeds.plunge > MmPerSecond(0) ? ToolsJson(speed_per_minute(feeds.plunge)) : ToolsJson()},
      {"depth_per_pass_mm", known_length(feeds.depth_per_pass)},
      {"step_over_percent", feeds.step_over > 0 ? ToolsJson(feeds.step_over * 100) : ToolsJson()},
      {"chip_load_mm", feeds.chip_load.value()},
      {"chip_load_least_mm", feeds.chip_range.least.value()},
      {"chip_load_most_mm", feeds.chip_range.most.value()}};
  json["reasons"] = ToolsJson::array();
  for (const FeedReason& reason : feeds.reasons) {
    json["reasons"].push_back({{"of", reason.of},
                               {"text", reason.text},
                               {"source", reason.source.empty() ? ToolsJson() : ToolsJson(reason.source)}});
  }
  return json;
}

// A given depth of a pass is checked as that of a cut: the feeds themselves do not depend on the flutes.
std::vector<ToolWarning> depth_warnings(const CuttingTool& tool, double depth) {
  return warnings_of(tool, {.depth = Mm(depth), .depth_per_pass = Mm(depth)}, std::nullopt);
}

void print_feeds(const CuttingTool& tool, WorkMaterial material, const CuttingFeeds& feeds) {
  fmt::print("{} in {}\n\n", describe(tool), name_of(material));
  const auto row = [&](std::string_view name, const std::string& value, std::string_view of) {
    fmt::print("{:<10} {:<18}", name, value);
    bool is_first = true;
    for (const FeedReason& reason : feeds.reasons) {
      if (reason.of != of) continue;
      fmt::print("{}{}\n", is_first ? "" : fmt::format("{:29}", ""), reason.text);
      if (!reason.source.empty()) fmt::print("{:31}{}\n", "", reason.source);
      is_first = false;
    }
    if (is_first) fmt::print("\n");
  };
  row("chip load", fmt::format("{:.3g} mm/tooth", feeds.chip_load.value()), "chip load");
  row("spindle", fmt::format("{:g} rpm", feeds.rpm), "spindle");
  row("feed", fmt::format("{:g} mm/min", speed_per_minute(feeds.feed)), "feed");
  row("plunge", feeds.plunge > MmPerSecond(0) ? fmt::format("{:g} mm/min", speed_per_minute(feeds.plunge)) : "none",
      "plunge");
  if (feeds.depth_per_pass > Mm(0))
    row("depth", fmt::format("{:.3g} mm per pass", feeds.depth_per_pass.value()), "depth");
  if (feeds.step_over > 0) row("stepover", fmt::format("{:g} %", feeds.step_over * 100), "stepover");
  if (feeds.chip_load < feeds.chip_range.least * 0.5) {
    note(
        fmt::format("{:.3g} mm per tooth is less than half of {:.3g} mm, so the teeth rub. Use fewer flutes, a smaller "
                    "tool, or a slower spindle [tool.chip-small]",
                    feeds.chip_load.value(), feeds.chip_range.least.value()));
  }
}

}  // namespace

int tools_list(const ToolsListArguments& arguments) {
  const auto library = shown_library(arguments.library);
  if (!library) return exit_bad_program;
  if (arguments.json) {
    fmt::print("{}", tool_library_json(library->tools(), arguments.library));
    return flush_output();
  }
  fmt::print("{:<6} {:<7} {:>8} {:>6} {:>8} {:>9} {:>7}  {:<7}  {}\n", "tool", "shape", "diameter", "flutes", "cuts to",
             "stick-out", "max rpm", "of", "name");
  for (const CuttingTool& tool : library->tools()) {
    const std::string rpm = tool.most_rpm ? fmt::format("{:g}", *tool.most_rpm) : "-";
    const std::string_view plunges = tool.centre_cutting ? "" : "(does not plunge)";
    std::string line = fmt::format("{:<6} {:<7} {:>8g} {:>6} {:>8} {:>9} {:>7}  {:<7}  {}{}{}",
                                   fmt::format("T{}", tool.number), name_of(tool.shape), tool.diameter.value(),
                                   tool.flutes, length_cell(tool.flute_length), length_cell(tool.stick_out), rpm,
                                   name_of(tool.material), tool.name, tool.name.empty() ? "" : " ", plunges);
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  }
  return flush_output();
}

int tools_feeds(const ToolsFeedsArguments& arguments) {
  const auto library = shown_library(arguments.library);
  if (!library) return exit_bad_program;
  const auto number = parse_tool_number(arguments.tool);
  const CuttingTool* const tool = number ? library->find(*number) : nullptr;
  if (tool == nullptr) {
    return fail(exit_bad_program, fmt::format("--tool: expected one of {}, found '{}' [tool.unknown]",
                                              library->numbers(), arguments.tool));
  }
  FeedRequest request{.material = *work_material_of(arguments.material),
                      .depth = Mm(arguments.depth),
                      .width = arguments.width / 100,
                      .rpm = arguments.rpm};
  if (!arguments.machine.empty()) {
    Diagnostics findings;
    const auto machine = load_machine_file(arguments.machine, findings, MachineUse::any_board);
    show(findings);
    if (!machine) return exit_bad_machine;
    const ToolLimits limits = tool_limits_of(*machine);
    request.spindle = limits.spindle;
    request.most_feed = limits.most_feed;
    request.most_plunge = limits.most_plunge;
  }
  if (arguments.least_rpm) request.spindle.least_rpm = *arguments.least_rpm;
  if (arguments.most_rpm) request.spindle.most_rpm = *arguments.most_rpm;
  if (request.spindle.most_rpm > 0 && request.spindle.least_rpm > request.spindle.most_rpm) {
    return fail(exit_bad_program, fmt::format("--min-rpm: expected at most {:g}, found {:g}", request.spindle.most_rpm,
                                              request.spindle.least_rpm));
  }
  const CuttingFeeds feeds = feeds_of(*tool, request);
  ToolsJson warnings = ToolsJson::array();
  Diagnostics findings;
  for (const ToolWarning& warning : depth_warnings(*tool, arguments.depth)) {
    findings.add(finding_of(warning, library->file()));
    warnings.push_back(json_of(warning, tool->number));
  }
  show(findings);
  if (arguments.json) {
    ToolsJson json = json_of(*tool, request.material, feeds);
    json["warnings"] = warnings;
    return print_tools_json(json);
  }
  print_feeds(*tool, request.material, feeds);
  return flush_output();
}

}  // namespace passo
