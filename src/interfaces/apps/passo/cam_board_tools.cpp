// The tools of a library for the operations of circuit boards.
#include <algorithm>
#include <cmath>
#include <vector>

#include "cam_tools.hpp"
#include "tool_shelf.hpp"
#include <fmt/format.h>

#include "passo/base/trimmed.hpp"

namespace passo {
namespace {

constexpr const char* all_drills = "all";
// A hole has straight walls, or is a centre mark or a countersink, which V-bits make.
constexpr std::initializer_list<CuttingShape> drilling_shapes = {CuttingShape::drill, CuttingShape::flat,
                                                                 CuttingShape::bull, CuttingShape::vee};

// The tool of a rack that fits a hole best must make straight walls.
constexpr std::initializer_list<CuttingShape> rack_shapes = {CuttingShape::drill, CuttingShape::flat,
                                                             CuttingShape::bull};

// "1, T3" is "1" and "T3".
std::vector<std::string> items_of(std::string_view list) {
  std::vector<std::string> items;
  while (!list.empty()) {
    const std::string_view one = list.substr(0, list.find(','));
    list.remove_prefix(std::min(list.size(), one.size() + 1));
    items.emplace_back(trimmed(one, " "));
  }
  return items;
}

bool names_rack(const std::string& tools) {
  return tools == all_drills || std::ranges::any_of(items_of(tools), is_tool_number);
}

// A drill of the rack has its own feed and speed.
void add_drill(const ToolShelf& shelf, const CuttingTool& tool, CamDrillArguments& a, const IsGiven& is_given) {
  CamDrillFeed drill{.diameter_mm = tool.diameter.value()};
  FeedRequest request;
  if (is_given("--spindle")) request.rpm = a.spindle;
  ToolUse use{.depth = Mm(-shelf.mm("--depth", a.depth))};
  if (const auto feeds = shelf.feeds(tool, request)) {
    // A drill is fed down; an end mill plunges.
    const bool is_drill = tool.shape == CuttingShape::drill;
    drill.feed_mm =
        is_given("--feed") ? shelf.mm("--feed", a.feed) : per_minute(is_drill ? feeds->feed : feeds->plunge);
    drill.spindle = is_given("--spindle") ? a.spindle : static_cast<std::uint32_t>(feeds->rpm);
    if (is_drill) use.rpm = feeds->rpm;
    use.feed = MmPerSecond(drill.feed_mm / seconds_per_minute);
  }
  drill.words = shelf.describe_use("drill", tool, use);
  a.drill_feeds.push_back(drill);
}

// Replaces tool numbers in --tools by diameters. Returns an exit code.
int take_rack(ToolShelf& shelf, CamDrillArguments& a, const IsGiven& is_given) {
  if (!names_rack(a.tools)) return exit_done;
  std::vector<std::string> diameters;
  if (a.tools == all_drills) {
    for (const CuttingTool& tool : shelf.library().tools()) {
      if (tool.shape != CuttingShape::drill) continue;
      add_drill(shelf, tool, a, is_given);
      diameters.push_back(mm_text(tool.diameter.value()));
    }
    if (diameters.empty()) {
      return shelf.refuse(fmt::format("--tools all: expected a tool of shape drill among {} [tool.wrong-shape]",
                                      shelf.library().numbers()));
    }
  } else {
    for (const std::string& item : items_of(a.tools)) {
      const CuttingTool* const tool = shelf.find("--tools", item, rack_shapes);
      if (shelf.code() != exit_done) return shelf.code();
      if (tool != nullptr) {
        add_drill(shelf, *tool, a, is_given);
        shelf.judge(*tool, {.depth = Mm(-shelf.mm("--depth", a.depth)), .plunges = true});
      }
      diameters.push_back(tool == nullptr ? item : mm_text(tool->diameter.value()));
    }
  }
  a.tools = fmt::format("{}", fmt::join(diameters, ","));
  return exit_done;
}

// All cutters of a program have the same feeds: those of the cutter that bears least.
void fill_in_least(const ToolShelf& shelf, const std::vector<const CuttingTool*>& tools, Mm depth,
                   CamIsolateArguments& a, const IsGiven& is_given) {
  FeedRequest request{.depth = depth};
  if (is_given("--spindle") && a.spindle > 0) request.rpm = a.spindle;
  double rpm = 0;
  for (const CuttingTool* const tool : tools) {
    const auto feeds = shelf.feeds(*tool, request);
    if (!feeds) return;
    rpm = rpm == 0 ? feeds->rpm : std::min(rpm, feeds->rpm);
  }
  request.rpm = rpm;
  double feed = 0;
  double plunge = 0;
  for (const CuttingTool* const tool : tools) {
    const auto feeds = shelf.feeds(*tool, request);
    feed = feed == 0 ? per_minute(feeds->feed) : std::min(feed, per_minute(feeds->feed));
    plunge = plunge == 0 ? descent_of(*feeds) : std::min(plunge, descent_of(*feeds));
  }
  if (!is_given("--spindle")) a.spindle = static_cast<std::uint32_t>(rpm);
  fill_in(a.feed, "--feed", feed, is_given);
  fill_in(a.plunge_feed, "--plunge-feed", plunge, is_given);
}

}  // namespace

int use_tools(CamDrillArguments& a, const IsGiven& is_given) {
  ToolShelf shelf(a, a.units);
  const bool wants = is_tool_number(a.drill) || is_tool_number(a.mill) || names_rack(a.tools);
  if (const int code = shelf.open(wants); code != exit_done || !shelf.is_open()) return code;
  const CuttingTool* const drill = shelf.find("--drill", a.drill, drilling_shapes);
  const CuttingTool* const mill = shelf.find("--mill", a.mill, {CuttingShape::flat, CuttingShape::bull});
  if (shelf.code() != exit_done) return shelf.code();
  if (const int code = take_rack(shelf, a, is_given); code != exit_done) return code;
  const Mm depth(-shelf.mm("--depth", a.depth));
  if (drill != nullptr) {
    a.drill = mm_text(drill->diameter.value());
    const auto feeds = fill_in_feeds(shelf, *drill, {}, a, is_given);
    if (feeds && drill->shape != CuttingShape::drill) fill_in(a.feed, "--feed", per_minute(feeds->plunge), is_given);
    ToolUse use = use_of(shelf, a);
    use.depth = depth;
    use.plunges = true;
    if (drill->shape != CuttingShape::drill) use.rpm = 0;  // chip loads of milling do not apply to a plunge
    shelf.remark("drill", *drill, use);
    shelf.judge(*drill, use);
  }
  if (mill != nullptr) {
    a.mill = mm_text(mill->diameter.value());
    FeedRequest request{.depth = Mm(shelf.mm("--mill-step", a.mill_step))};
    if (drill != nullptr || is_given("--spindle")) request.rpm = a.spindle;
    if (const auto feeds = shelf.feeds(*mill, request)) {
      if (!request.rpm) a.spindle = static_cast<std::uint32_t>(feeds->rpm);
      fill_in(a.mill_feed, "--mill-feed", per_minute(feeds->feed), is_given);
    }
    ToolUse use{.rpm = static_cast<double>(a.spindle),
                .feed = MmPerSecond(shelf.mm("--mill-feed", a.mill_feed) / seconds_per_minute),
                .depth = depth,
                .depth_per_pass = Mm(shelf.mm("--mill-step", a.mill_step))};
    shelf.remark("mill", *mill, use);
    shelf.judge(*mill, use);
  }
  return shelf.finish();
}

int use_tools(CamIsolateArguments& a, const IsGiven& is_given) {
  ToolShelf shelf(a, a.units);
  const std::vector<std::string> items = items_of(a.tools);
  const bool wants = std::ranges::any_of(items, is_tool_number);
  if (const int code = shelf.open(wants); code != exit_done || !shelf.is_open()) return code;
  std::vector<const CuttingTool*> tools;
  std::vector<std::string> widths;
  for (const std::string& item : items) {
    const CuttingTool* const tool = shelf.find("--tool", item, {CuttingShape::flat, CuttingShape::vee});
    if (shelf.code() != exit_done) return shelf.code();
    if (tool != nullptr) tools.push_back(tool);
    if (tool == nullptr || tool->shape == CuttingShape::flat) {
      widths.push_back(tool == nullptr ? item : mm_text(tool->diameter.value()));
    } else if (a.v.empty()) {
      a.v = fmt::format("{:.10g},{}", tool->angle.value * degrees_of_radian, mm_text(tool->tip.value()));
    } else {
      return shelf.refuse("--tool: expected at most one V-shaped cutter [tool.wrong-shape]");
    }
  }
  a.tools = fmt::format("{}", fmt::join(widths, ","));
  const Mm depth(-shelf.mm("--depth", a.depth));
  fill_in_least(shelf, tools, depth, a, is_given);
  ToolUse use = use_of(shelf, a);
  use.depth = depth;
  use.depth_per_pass = depth;
  use.plunges = true;
  for (const CuttingTool* const tool : tools) {
    shelf.remark("tool", *tool, use);
    shelf.judge(*tool, use);
  }
  return shelf.finish();
}

int use_tools(CamOutlineArguments& a, const IsGiven& is_given) {
  ToolShelf shelf(a, a.units);
  if (const int code = shelf.open(is_tool_number(a.tool)); code != exit_done || !shelf.is_open()) return code;
  const CuttingTool* const tool = shelf.find("--tool", a.tool, end_mills);
  if (tool == nullptr) return shelf.code();
  const ToolUse use = use_in_layers(shelf, *tool, 1, a, is_given);
  shelf.remark("tool", *tool, use);
  shelf.judge(*tool, use);
  return shelf.finish();
}

int use_tools(const CamToolArguments& board, CamDrillArguments& drill, const IsGiven& is_given_drill,
              CamIsolateArguments& isolate, const IsGiven& is_given_isolate, CamOutlineArguments& outline,
              const IsGiven& is_given_outline) {
  const auto take = [&](auto& arguments, bool names_tool) {
    static_cast<CamToolArguments&>(arguments) = names_tool ? board : CamToolArguments{};
  };
  if (board.tool_table.empty()) {
    if (!board.material.empty() || !board.limits.empty())
      return fail(exit_bad_program, "--material and --limits need --tool-table FILE [tool.no-library]");
  } else {
    Diagnostics findings;
    const auto library = ToolLibrary::read(board.tool_table, findings);
    show(findings);
    if (!library) return exit_bad_program;
    const bool has_drill = std::ranges::any_of(
        library->tools(), [](const CuttingTool& tool) { return tool.shape == CuttingShape::drill; });
    if (drill.tools.empty() && drill.drill.empty() && has_drill) drill.tools = all_drills;
  }
  const auto items = items_of(isolate.tools);
  const bool names[] = {is_tool_number(drill.drill) || is_tool_number(drill.mill) || names_rack(drill.tools),
                        std::ranges::any_of(items, is_tool_number), is_tool_number(outline.tool)};
  take(drill, names[0]);
  take(isolate, names[1]);
  take(outline, names[2]);
  if (!board.tool_table.empty() && std::ranges::none_of(names, std::identity{})) {
    return fail(exit_bad_program,
                "--tool-table: expected a drill in the library, or a tool by its number in the profile, e.g. tool = "
                "\"T1\" in [isolate] [tool.none-chosen]");
  }
  if (const int code = use_tools(drill, is_given_drill); code != exit_done) return code;
  if (const int code = use_tools(isolate, is_given_isolate); code != exit_done) return code;
  return use_tools(outline, is_given_outline);
}

}  // namespace passo
