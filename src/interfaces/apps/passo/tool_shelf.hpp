// ToolShelf: the library of a command's tools, from which use_tools() fills in arguments. Private to `passo cam`.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string>

#include "cam_tools.hpp"
#include "program_input.hpp"
#include "tool_limits.hpp"
#include <nlohmann/json.hpp>

#include "passo/operations/length_text.hpp"
#include "passo/tooling/cutting_feeds.hpp"
#include "passo/tooling/tool_library.hpp"
#include "passo/tooling/tool_warnings.hpp"

namespace passo {

constexpr double degrees_of_radian = 180 / std::numbers::pi;
constexpr double usual_tool_ramp = 5;  // degrees, for a tool that cannot plunge
constexpr std::initializer_list<CuttingShape> end_mills = {CuttingShape::flat, CuttingShape::ball, CuttingShape::bull};

// "6.35mm"
std::string mm_text(double mm);
// Whether the text is the number of a tool in a library: T3.
bool is_tool_number(const std::string& text);

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

  const ToolLibrary& library() const { return *library_; }

  // Describes the tool and its use, for the head of the program.
  std::string describe_use(const char* option, const CuttingTool& tool, const ToolUse& use) const;
  // Adds this to the head of the program.
  void remark(const char* option, const CuttingTool& tool, const ToolUse& use);
  // Shows the warnings about the use.
  void judge(const CuttingTool& tool, const ToolUse& use);
  // Writes the findings into the arguments. Returns an exit code.
  int finish();

  int code() const { return code_; }
  // Shows the message, which is then the result. Returns its exit code.
  int refuse(const std::string& message);
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
  nlohmann::ordered_json warnings_ = nlohmann::ordered_json::array();
  int code_ = exit_done;
};

// Sets an option that the user has not given to a length.
void fill_in(std::string& option, const char* name, double mm, const IsGiven& is_given);
double per_minute(MmPerSecond speed);
// The feed of a descent along a ramp.
double descent_of(const CuttingFeeds& feeds);

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
  if (!tool.centre_cutting && !is_given("--ramp")) a.ramp = std::max(a.ramp, usual_tool_ramp);
  ToolUse use = use_of(shelf, a);
  use.depth = Mm(depth);
  use.depth_per_pass = Mm(std::min(shelf.mm("--step", a.step), depth));
  use.width = width;
  use.plunges = a.ramp == 0;
  return use;
}

}  // namespace passo
