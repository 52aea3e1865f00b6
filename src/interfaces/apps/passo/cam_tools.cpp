#include "cam_tools.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "chamfer_cut.hpp"
#include "program_input.hpp"
#include "tool_shelf.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace passo {
namespace {

using ToolJson = nlohmann::ordered_json;

// `tool`: null: the cutter is given by its dimensions, or not at all.
int use_for_chamfer(ToolShelf& shelf, const CuttingTool* tool, CamProfileArguments& a, const IsGiven& is_given) {
  if (tool != nullptr) {
    a.tool = mm_text(tool->diameter.value());
    if (!is_given("--angle")) a.angle = tool->angle.value * degrees_of_radian;
    if (!is_given("--tip")) a.tip = mm_text(tool->tip.value());
  }
  const double width = shelf.mm("--chamfer", a.chamfer);
  const double cutter = shelf.mm("--tool", a.tool);
  // The diameter that --tool has by default is that of an end mill: it says nothing about the V-shaped cutter.
  const bool knows_cutter = tool != nullptr || (is_given("--tool") && cutter > 0);
  if (const double most = most_chamfer_mm(cutter, shelf.mm("--tip", a.tip)); knows_cutter && width > most) {
    const std::string expected = most < 0.001 ? std::string("a wider cutter or a narrower tip")
                                              : fmt::format("at most {:g} mm", std::floor(most * 1000) / 1000);
    return fail(exit_bad_program,
                fmt::format("--chamfer: expected {} with a cutter of {:g} mm and a tip of {:g} mm, found '{}' "
                            "[tool.chamfer-width]",
                            expected, cutter, shelf.mm("--tip", a.tip), a.chamfer));
  }
  if (tool == nullptr) return exit_done;
  const Mm depth(chamfer_depth_mm(width, a.angle));
  if (const auto feeds = fill_in_feeds(shelf, *tool, {.depth = depth}, a, is_given)) {
    fill_in(a.plunge_feed, "--plunge-feed", descent_of(*feeds), is_given);
  }
  ToolUse use = use_of(shelf, a);
  use.depth = depth;
  use.depth_per_pass = depth;
  use.plunges = true;
  shelf.remark("tool", *tool, use);
  shelf.judge(*tool, use);
  return shelf.finish();
}

// Reliefs are carved by any cutter that can move sideways.
constexpr std::initializer_list<CuttingShape> milling_shapes = {
    CuttingShape::flat, CuttingShape::ball, CuttingShape::bull, CuttingShape::vee, CuttingShape::taper};
ToolUse relief_use(const ToolShelf& shelf, const CamReliefArguments& a, const std::string& feed) {
  ToolUse use = use_of(shelf, a);
  if (!feed.empty()) use.feed = MmPerSecond(shelf.mm("--feed", feed) / seconds_per_minute);
  use.depth = Mm(std::max(0.0, -shelf.mm("--depth", a.depth.empty() ? "0" : a.depth)));
  use.plunges = a.entry == "plunge";
  return use;
}

std::string cutter_text(const CuttingTool& tool) {
  const double d = tool.diameter.value();
  const double degrees = tool.angle.value * degrees_of_radian;
  switch (tool.shape) {
    case CuttingShape::thread_mill:
    case CuttingShape::flat: return fmt::format("flat:{:.10g}", d);
    case CuttingShape::ball: return fmt::format("ball:{:.10g}", d);
    case CuttingShape::bull: return fmt::format("bull:{:.10g}:{:.10g}", d, tool.corner_radius.value());
    case CuttingShape::vee:
    case CuttingShape::drill: return fmt::format("vee:{:.10g}:{:.10g}:{:.10g}", degrees, d, tool.tip.value());
    case CuttingShape::taper: return fmt::format("taper:{:.10g}:{:.10g}:{:.10g}", tool.tip.value(), degrees / 2, d);
  }
  return "";
}

}  // namespace

int use_tools(CamProfileArguments& a, const IsGiven& is_given) {
  ToolShelf shelf(a, a.units);
  const bool is_chamfer = !a.chamfer.empty();
  if (const int code = shelf.open(is_tool_number(a.tool)); code != exit_done) return code;
  const CuttingTool* tool = nullptr;
  if (shelf.is_open()) {
    // The walls of a part are upright only if the flanks of the cutter are.
    tool = is_chamfer ? shelf.find("--tool", a.tool, {CuttingShape::vee}) : shelf.find("--tool", a.tool, end_mills);
    if (tool == nullptr) return shelf.code();
  }
  if (is_chamfer) return use_for_chamfer(shelf, tool, a, is_given);
  if (tool == nullptr) return exit_done;
  const ToolUse use = use_in_layers(shelf, *tool, 1, a, is_given);
  shelf.remark("tool", *tool, use);
  shelf.judge(*tool, use);
  return shelf.finish();
}

int use_tools(CamPocketArguments& a, const IsGiven& is_given) {
  ToolShelf shelf(a, a.units);
  if (const int code = shelf.open(is_tool_number(a.tool)); code != exit_done || !shelf.is_open()) return code;
  const CuttingTool* const tool = shelf.find("--tool", a.tool, end_mills);
  if (tool == nullptr) return shelf.code();
  if (!a.material.empty() && !is_given("--step-over")) a.step_over = 50;
  // Adaptive clearing keeps the engagement: half the width is a quarter turn.
  constexpr double quarter = 90;
  const bool is_narrow = a.engagement > 0 && a.engagement < quarter;
  const double width = is_narrow ? (1 - std::cos(a.engagement / degrees_of_radian)) / 2 : 1;
  ToolUse use = use_in_layers(shelf, *tool, width, a, is_given);
  use.step_over = tool->diameter * (a.step_over / 100);
  shelf.remark("tool", *tool, use);
  shelf.judge(*tool, use);
  return shelf.finish();
}

int use_tools(CamEngraveArguments& a, const IsGiven& is_given) {
  ToolShelf shelf(a, a.units);
  const bool wants = is_tool_number(a.tool) || is_tool_number(a.clear);
  if (const int code = shelf.open(wants); code != exit_done || !shelf.is_open()) return code;
  const CuttingTool* const tool = shelf.find("--tool", a.tool, {CuttingShape::vee});
  const CuttingTool* const clearing = shelf.find("--clear", a.clear, end_mills);
  if (shelf.code() != exit_done) return shelf.code();
  const double depth = a.depth.empty() ? 0 : -shelf.mm("--depth", a.depth);
  if (tool != nullptr) {
    a.tool = mm_text(tool->diameter.value());
    if (!is_given("--angle")) a.angle = tool->angle.value * degrees_of_radian;
    if (!is_given("--tip")) a.tip = mm_text(tool->tip.value());
    if (const auto feeds = fill_in_feeds(shelf, *tool, {.depth = Mm(depth)}, a, is_given)) {
      fill_in(a.plunge_feed, "--plunge-feed", descent_of(*feeds), is_given);
    }
    ToolUse use = use_of(shelf, a);
    use.depth = Mm(depth);
    use.depth_per_pass = Mm(depth);
    use.plunges = true;
    shelf.remark("tool", *tool, use);
    shelf.judge(*tool, use);
  }
  if (clearing != nullptr) {
    a.clear = mm_text(clearing->diameter.value());
    if (tool == nullptr) {
      if (const auto feeds = fill_in_feeds(shelf, *clearing, {}, a, is_given)) {
        fill_in(a.plunge_feed, "--plunge-feed", descent_of(*feeds), is_given);
      }
    }
    if (const auto feeds = shelf.feeds(*clearing, {}))
      fill_in(a.clear_step, "--clear-step", feeds->depth_per_pass.value(), is_given);
    ToolUse use = use_of(shelf, a);
    use.depth = Mm(depth);
    use.depth_per_pass = Mm(shelf.mm("--clear-step", a.clear_step));
    shelf.remark("clearing tool", *clearing, use);
    shelf.judge(*clearing, use);
  }
  return shelf.finish();
}

int use_tools(CamThreadArguments& a, const IsGiven& is_given) {
  ToolShelf shelf(a, a.units);
  if (const int code = shelf.open(is_tool_number(a.tool)); code != exit_done || !shelf.is_open()) return code;
  const CuttingTool* const tool = shelf.find("--tool", a.tool, {CuttingShape::thread_mill});
  if (tool == nullptr) return shelf.code();
  a.tool = mm_text(tool->diameter.value());
  fill_in(a.neck, "--neck", tool->neck_diameter.value(), is_given);
  fill_in(a.reach, "--reach", tool->reach.value(), is_given);
  fill_in(a.tooth_tip, "--tooth-tip", tool->tooth_tip.value(), is_given);
  if (!is_given("--teeth")) a.teeth = tool->teeth;
  if (tool->tooth_pitch > Mm(0)) a.tooth_pitch = mm_text(tool->tooth_pitch.value());
  static_cast<void>(fill_in_feeds(shelf, *tool, {}, a, is_given));
  const ToolUse use = use_of(shelf, a);
  shelf.remark("tool", *tool, use);
  shelf.judge(*tool, use);
  return shelf.finish();
}

int use_tools(CamReliefArguments& a, const IsGiven& is_given) {
  ToolShelf shelf(a, "mm");
  const bool wants = is_tool_number(a.cutter) || is_tool_number(a.rough) || is_tool_number(a.rest);
  if (const int code = shelf.open(wants); code != exit_done || !shelf.is_open()) return code;
  const CuttingTool* const finish = shelf.find("--cutter", a.cutter, milling_shapes);
  const CuttingTool* const rough = shelf.find("--rough", a.rough, milling_shapes);
  const CuttingTool* const rest = shelf.find("--rest", a.rest, milling_shapes);
  if (shelf.code() != exit_done) return shelf.code();
  if (finish != nullptr) {
    a.cutter = cutter_text(*finish);
    if (const auto feeds = fill_in_feeds(shelf, *finish, {}, a, is_given)) {
      fill_in(a.plunge, "--plunge", descent_of(*feeds), is_given);
    }
    ToolUse use = relief_use(shelf, a, "");
    if (!a.step.empty()) use.step_over = Mm(shelf.mm("--step", a.step));
    shelf.remark("cutter", *finish, use);
    shelf.judge(*finish, use);
  }
  const auto add = [&](const char* option, const CuttingTool& tool, std::string& cutter, std::string& step,
                       const char* step_option, std::string& feed, const char* feed_option, std::string* down) {
    cutter = cutter_text(tool);
    FeedRequest request;
    if (a.spindle > 0) request.rpm = a.spindle;
    if (const auto feeds = shelf.feeds(tool, request)) {
      fill_in(feed, feed_option, per_minute(feeds->feed), is_given);
      if (down != nullptr) fill_in(*down, "--rough-down", feeds->depth_per_pass.value(), is_given);
    }
    ToolUse use = relief_use(shelf, a, feed);
    if (!step.empty()) use.step_over = Mm(shelf.mm(step_option, step));
    if (down != nullptr) use.depth_per_pass = Mm(shelf.mm("--rough-down", *down));
    shelf.remark(option, tool, use);
    shelf.judge(tool, use);
  };
  if (rough != nullptr) {
    add("roughing", *rough, a.rough, a.rough_step, "--rough-step", a.rough_feed, "--rough-feed", &a.rough_down);
  }
  if (rest != nullptr) add("rest", *rest, a.rest, a.rest_step, "--rest-step", a.rest_feed, "--rest-feed", nullptr);
  return shelf.finish();
}

void say_summary(ToolJson summary, const CamToolArguments& arguments) {
  const RecordedMessages* const shown = RecordedMessages::current();
  ToolJson warnings = ToolJson::parse(arguments.tool_warnings_json, nullptr, false);
  const bool has_tool_warnings = warnings.is_array();
  if (!has_tool_warnings) warnings = ToolJson::array();
  const auto is_of_tool = [&](const Diagnostic& warning) {
    return std::ranges::any_of(warnings, [&](const ToolJson& one) {
      return one.value("code", "") == warning.code && one.value("message", "") == std::string(warning.message);
    });
  };
  if (shown != nullptr) {
    for (const Diagnostic& warning : shown->warnings) {
      if (is_of_tool(warning)) continue;
      warnings.push_back({{"code", warning.code},
                          {"file", warning.file},
                          {"message", std::string(warning.message)},
                          {"advice", std::string(warning.expected)}});
    }
    if (!shown->notes.empty()) summary["notes"] = shown->notes;
  }
  const bool has_notes = shown != nullptr && !shown->notes.empty();
  if (has_tool_warnings || has_notes || !warnings.empty()) summary["warnings"] = std::move(warnings);
  say(summary.dump(2, ' ', false, ToolJson::error_handler_t::replace) + "\n");
}

}  // namespace passo
