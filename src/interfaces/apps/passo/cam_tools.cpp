#include "cam_tools.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "chamfer_cut.hpp"
#include "length_argument.hpp"
#include "program_input.hpp"
#include "tool_limits.hpp"
#include "tool_warning_words.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/tooling/cutting_feeds.hpp"
#include "passo/tooling/tool_library.hpp"
#include "passo/tooling/tool_warnings.hpp"

namespace passo {
namespace {

using ToolJson = nlohmann::ordered_json;

constexpr double degrees_of_radian = 180 / std::numbers::pi;
constexpr double usual_ramp = 5;  // degrees, for a tool that cannot plunge

std::string mm_text(double mm) {
  return fmt::format("{:.10g}mm", mm);
}

bool is_tool_number(const std::string& text) {
  return text.starts_with('T') && parse_tool_number(text).has_value();
}

// The library of a command and what is known of the machine. Collects remarks and warnings for the arguments.
class ToolShelf {
 public:
  ToolShelf(CamToolArguments& arguments, const std::string& units)
      : arguments_(arguments), unit_mm_(*mm_of_unit(units)) {}

  // Reads the files. Returns an exit code. `wants_tool`: some option names a tool by its number.
  int open(bool wants_tool);
  bool is_open() const { return library_.has_value(); }

  // Returns the tool that an option names by its number. Null: it names none, or there is no such tool: see
  // code().
  const CuttingTool* find(const char* option, const std::string& text);
  // Like find(), and the tool must have one of the shapes.
  const CuttingTool* find(const char* option, const std::string& text, std::initializer_list<CuttingShape> shapes);
  // Returns nothing if the material is unknown.
  std::optional<CuttingFeeds> feeds(const CuttingTool& tool, FeedRequest request = {}) const;

  // Adds the tool to the head of the program.
  void remark(const char* option, const CuttingTool& tool, const ToolUse& use);
  // Shows the warnings about the use.
  void judge(const CuttingTool& tool, const ToolUse& use);
  // Writes the findings into the arguments. Returns an exit code.
  int finish();

  int code() const { return code_; }
  // A length in mm; 0 if it is invalid, which the command itself refuses later.
  double mm(const char* option, const std::string& text) const {
    const Result<Mm, std::string> length = parse_length(option, text, unit_mm_);
    return length ? length->value() : 0;
  }

 private:
  CamToolArguments& arguments_;
  double unit_mm_;
  std::optional<ToolLibrary> library_;
  std::optional<WorkMaterial> material_;
  ToolLimits limits_;
  Diagnostics findings_;
  ToolJson warnings_ = ToolJson::array();
  int code_ = exit_done;
};

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
  const auto machine = load_machine_file(a.limits, of_machine);
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

void ToolShelf::remark(const char* option, const CuttingTool& tool, const ToolUse& use) {
  std::string words = fmt::format("{}: {}", option, describe(tool));
  const double per_turn = use.rpm > 0 ? use.feed.value() * seconds_per_minute / use.rpm : 0;
  if (material_ && per_turn > 0) {
    words += fmt::format("; {:.3g} mm per tooth in {}", per_turn / tool.flutes, name_of(*material_));
  }
  arguments_.tool_remarks.push_back(std::move(words));
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
  arguments_.tool_warnings_json = warnings_.dump(-1, ' ', false, ToolJson::error_handler_t::replace);
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

// Feeds, plunge feed and spindle of drawings and their like. `request` may have a depth of a pass and a width.
template <class Arguments>
std::optional<CuttingFeeds> fill_in_feeds(const ToolShelf& shelf, const CuttingTool& tool, FeedRequest request,
                                          Arguments& a, const IsGiven& is_given) {
  if (is_given("--spindle") && a.spindle > 0) request.rpm = a.spindle;
  const std::optional<CuttingFeeds> feeds = shelf.feeds(tool, request);
  if (!feeds) return feeds;
  if (!is_given("--spindle")) a.spindle = static_cast<std::uint32_t>(feeds->rpm);
  fill_in(a.feed, "--feed", per_minute(feeds->feed), is_given);
  return feeds;
}

template <class Arguments>
ToolUse use_of(const ToolShelf& shelf, const Arguments& a) {
  return {.rpm = static_cast<double>(a.spindle), .feed = MmPerSecond(shelf.mm("--feed", a.feed) / seconds_per_minute)};
}

// What profile and pocket have in common. `tool`: was found.
template <class Arguments>
ToolUse use_in_layers(ToolShelf& shelf, const CuttingTool& tool, double width, Arguments& a, const IsGiven& is_given) {
  a.tool = mm_text(tool.diameter.value());
  const double depth = -shelf.mm("--depth", a.depth);
  FeedRequest request{.width = width};
  if (is_given("--step")) request.depth = Mm(std::min(shelf.mm("--step", a.step), depth));
  if (const auto feeds = fill_in_feeds(shelf, tool, request, a, is_given)) {
    fill_in(a.plunge_feed, "--plunge-feed", descent_of(*feeds), is_given);
    fill_in(a.step, "--step", feeds->depth_per_pass.value(), is_given);
  }
  if (!tool.centre_cutting && !is_given("--ramp")) a.ramp = std::max(a.ramp, usual_ramp);
  ToolUse use = use_of(shelf, a);
  use.depth = Mm(depth);
  use.depth_per_pass = Mm(std::min(shelf.mm("--step", a.step), depth));
  use.width = width;
  use.plunges = a.ramp == 0;
  return use;
}

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

constexpr std::initializer_list<CuttingShape> end_mills = {CuttingShape::flat, CuttingShape::ball, CuttingShape::bull};

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
  const CuttingTool* const tool =
      a.on_line ? shelf.find("--tool", a.tool) : shelf.find("--tool", a.tool, {CuttingShape::vee});
  const CuttingTool* const clearing = shelf.find("--clear", a.clear, end_mills);
  if (shelf.code() != exit_done) return shelf.code();
  const double depth = a.depth.empty() ? 0 : -shelf.mm("--depth", a.depth);
  if (tool != nullptr) {
    a.tool = mm_text(tool->diameter.value());
    if (tool->shape == CuttingShape::vee) {
      if (!is_given("--angle")) a.angle = tool->angle.value * degrees_of_radian;
      if (!is_given("--tip")) a.tip = mm_text(tool->tip.value());
    }
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

int use_tools(CamDrillArguments& a, const IsGiven& is_given) {
  ToolShelf shelf(a, a.units);
  const bool wants = is_tool_number(a.drill) || is_tool_number(a.mill);
  if (const int code = shelf.open(wants); code != exit_done || !shelf.is_open()) return code;
  const CuttingTool* const drill = shelf.find("--drill", a.drill);
  const CuttingTool* const mill = shelf.find("--mill", a.mill, {CuttingShape::flat});
  if (shelf.code() != exit_done) return shelf.code();
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

int use_tools(CamReliefArguments& a, const IsGiven& is_given) {
  ToolShelf shelf(a, "mm");
  const bool wants = is_tool_number(a.cutter) || is_tool_number(a.rough) || is_tool_number(a.rest);
  if (const int code = shelf.open(wants); code != exit_done || !shelf.is_open()) return code;
  const CuttingTool* const finish = shelf.find("--cutter", a.cutter);
  const CuttingTool* const rough = shelf.find("--rough", a.rough);
  const CuttingTool* const rest = shelf.find("--rest", a.rest);
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

std::string with_tool_warnings(const std::string& json, const CamToolArguments& arguments) {
  if (arguments.tool_warnings_json.empty()) return json;
  ToolJson summary = ToolJson::parse(json, nullptr, false);
  if (!summary.is_object()) return json;
  summary["warnings"] = ToolJson::parse(arguments.tool_warnings_json, nullptr, false);
  return summary.dump(2);
}

}  // namespace passo
