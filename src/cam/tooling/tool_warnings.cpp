#include "passo/tooling/tool_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr double rubbing_share = 0.5;  // of the lower end of a table's range
constexpr double slack = 1e-9;

struct UseJudge {
  const CuttingTool& tool;
  std::optional<WorkMaterial> material;
  const SpindleRange& spindle;
  MmPerSecond most_feed;

  std::string named() const { return fmt::format("T{}", tool.number); }

  double chip(const ToolUse& use) const {
    if (!(use.rpm > 0) || !(use.feed > MmPerSecond(0))) return 0;
    const double thin = tool.shape == CuttingShape::drill ? 1 : chip_thinning(use.width);
    return use.feed.value() * seconds_per_minute / (use.rpm * tool.flutes) * thin;
  }
  // The feed in mm/min that gives this chip.
  double feed_for(const ToolUse& use, double wanted) const {
    return use.feed.value() * seconds_per_minute * wanted / chip(use);
  }
  double top_rpm() const {
    if (!tool.most_rpm) return spindle.most_rpm;
    return spindle.most_rpm > 0 ? std::min(spindle.most_rpm, *tool.most_rpm) : *tool.most_rpm;
  }
  // The use with a spindle speed that spindle and tool permit.
  ToolUse turning(const ToolUse& use) const {
    const auto warning = speed(use);
    return warning ? warning->advised : use;
  }
  ChipRange range(const ToolUse& use) const { return chip_range_of(tool, *material, use.depth_per_pass); }

  std::optional<ToolWarning> depth(const ToolUse& use) const;
  std::optional<ToolWarning> holder(const ToolUse& use) const;
  std::optional<ToolWarning> step_over(const ToolUse& use) const;
  std::optional<ToolWarning> small_chip(const ToolUse& use) const;
  std::optional<ToolWarning> large_chip(const ToolUse& use) const;
  std::optional<ToolWarning> plunge(const ToolUse& use) const;
  std::optional<ToolWarning> speed(const ToolUse& use) const;
  std::vector<ToolWarning> all(const ToolUse& use) const;
};

ToolUse no_deeper(ToolUse use, Mm depth) {
  use.depth = depth;
  use.depth_per_pass = std::min(use.depth_per_pass, depth);
  return use;
}

std::string feed_words(const char* what, const ToolUse& use, const ToolUse& advised) {
  const double feed = advised.feed.value() * seconds_per_minute;
  std::string words =
      feed < 10 ? fmt::format("{} {:.2g} mm/min", what, feed) : fmt::format("{} {:.0f} mm/min", what, feed);
  if (advised.rpm != use.rpm) words += fmt::format(" and a spindle speed of {:g} rpm", advised.rpm);
  return words;
}

std::optional<ToolWarning> UseJudge::depth(const ToolUse& use) const {
  const double most = tool.flute_length.value();
  if (most <= 0 || use.depth.value() <= most * (1 + slack)) return std::nullopt;
  return ToolWarning{
      .code = "tool.depth-over-flutes",
      .message = fmt::format("{} cuts {:g} mm deep, but its flutes are {:g} mm long", named(), use.depth.value(), most),
      .advice = fmt::format("a depth of at most {:g} mm, or a tool with longer flutes", most),
      .found = use.depth.value(),
      .limit = most,
      .advised = no_deeper(use, tool.flute_length)};
}

std::optional<ToolWarning> UseJudge::holder(const ToolUse& use) const {
  const double most = tool.stick_out.value();
  if (most <= 0 || use.depth.value() < most) return std::nullopt;
  const double safe = std::floor(most * 0.95 * 10) / 10;
  const Mm depth(safe > 0 ? safe : most / 2);
  return ToolWarning{
      .code = "tool.holder",
      .message = fmt::format("the holder of {} touches the material: the cut is {:g} mm deep, and the tool "
                             "sticks out {:g} mm",
                             named(), use.depth.value(), most),
      .advice = fmt::format("a depth of at most {:g} mm, or a tool with a longer stick-out", depth.value()),
      .found = use.depth.value(),
      .limit = most,
      .advised = no_deeper(use, depth)};
}

std::optional<ToolWarning> UseJudge::step_over(const ToolUse& use) const {
  if (use.step_over <= tool.diameter * (1 + slack)) return std::nullopt;
  ToolUse advised = use;
  advised.step_over = tool.diameter / 2;
  return ToolWarning{.code = "tool.step-over",
                     .message = fmt::format("passes {:g} mm apart leave material between them: {} is {:g} mm wide",
                                            use.step_over.value(), named(), tool.diameter.value()),
                     .advice = fmt::format("a stepover of {:g} mm, half the diameter", advised.step_over.value()),
                     .found = use.step_over.value(),
                     .limit = tool.diameter.value(),
                     .advised = advised};
}

std::optional<ToolWarning> UseJudge::small_chip(const ToolUse& use) const {
  const double found = chip(use);
  if (!material || found <= 0) return std::nullopt;
  const ChipRange permitted = range(use);
  const double limit = permitted.least.value() * rubbing_share;
  if (found >= limit * (1 - slack)) return std::nullopt;
  // The feed of the table, up to the machine's limit; if that is too slow, the spindle turns more slowly, too.
  ToolUse advised = turning(use);
  const double wanted = std::ceil(feed_for(advised, permitted.least.value()));
  const double most = most_feed.value() * seconds_per_minute;
  const bool is_too_fast = most > 0 && wanted > most;
  advised.feed = MmPerSecond((is_too_fast ? most : wanted) / seconds_per_minute);
  if (is_too_fast) {
    const double slower = std::floor(advised.rpm * chip(advised) / permitted.least.value() / 10) * 10;
    advised.rpm = std::max({slower, spindle.least_rpm, 10.0});
  }
  return ToolWarning{.code = "tool.chip-small",
                     .message = fmt::format("{} cuts {:.3g} mm per tooth in {}: below {:.3g} mm the teeth rub", named(),
                                            found, name_of(*material), limit),
                     .advice = feed_words("a feed of", use, advised),
                     .found = found,
                     .limit = limit,
                     .unit = "mm per tooth",
                     .advised = advised};
}

std::optional<ToolWarning> UseJudge::large_chip(const ToolUse& use) const {
  const double found = chip(use);
  if (!material || found <= 0) return std::nullopt;
  const double limit = range(use).most.value();
  if (found <= limit * 1.01) return std::nullopt;  // feeds are rounded
  ToolUse advised = turning(use);
  const double wanted = feed_for(advised, limit);
  advised.feed = MmPerSecond((wanted >= 2 ? std::floor(wanted) : wanted) / seconds_per_minute);
  return ToolWarning{.code = "tool.chip-large",
                     .message = fmt::format("{} cuts {:.3g} mm per tooth in {}: the tables permit at most {:.3g} mm",
                                            named(), found, name_of(*material), limit),
                     .advice = feed_words("a feed of at most", use, advised),
                     .found = found,
                     .limit = limit,
                     .unit = "mm per tooth",
                     .advised = advised};
}

std::optional<ToolWarning> UseJudge::plunge(const ToolUse& use) const {
  if (!use.plunges || tool.centre_cutting || tool.shape == CuttingShape::drill) return std::nullopt;
  ToolUse advised = use;
  advised.plunges = false;
  return ToolWarning{.code = "tool.plunge",
                     .message = fmt::format("{} plunges, but has no teeth at its centre", named()),
                     .advice = "a ramp, e.g. of 5 degrees, or a centre-cutting tool",
                     .unit = "",
                     .advised = advised};
}

std::optional<ToolWarning> UseJudge::speed(const ToolUse& use) const {
  const double top = top_rpm();
  const bool is_fast = top > 0 && use.rpm > top;
  const bool is_slow = use.rpm > 0 && use.rpm < spindle.least_rpm;
  if (!is_fast && !is_slow) return std::nullopt;
  ToolUse advised = use;
  advised.rpm = is_fast ? top : spindle.least_rpm;
  const bool by_tool = is_fast && tool.most_rpm && *tool.most_rpm == top;
  return ToolWarning{
      .code = "tool.spindle",
      .message = fmt::format("{:g} rpm: {} turns at {} {:g} rpm", use.rpm,
                             by_tool ? named() : std::string("the spindle"), is_fast ? "most" : "least", advised.rpm),
      .advice = fmt::format("a spindle speed of {:g} rpm", advised.rpm),
      .found = use.rpm,
      .limit = advised.rpm,
      .unit = "rpm",
      .advised = advised};
}

std::vector<ToolWarning> UseJudge::all(const ToolUse& use) const {
  std::vector<ToolWarning> warnings;
  for (auto& warning :
       {depth(use), holder(use), step_over(use), plunge(use), speed(use), small_chip(use), large_chip(use)}) {
    if (warning) warnings.push_back(warning.value());
  }
  return warnings;
}

bool has(const std::vector<ToolWarning>& warnings, const std::string& code) {
  return std::ranges::find(warnings, code, &ToolWarning::code) != warnings.end();
}

}  // namespace

std::vector<ToolWarning> warnings_of(const CuttingTool& tool, const ToolUse& use, std::optional<WorkMaterial> material,
                                     const SpindleRange& spindle, MmPerSecond most_feed) {
  const UseJudge judge{tool, material, spindle, most_feed};
  std::vector<ToolWarning> warnings = judge.all(use);
  for (ToolWarning& warning : warnings) {
    // The advice is checked. If it causes another warning, the advice of that one is added.
    constexpr int most_rounds = 4;
    for (int round = 0; round <= most_rounds; ++round) {
      const std::vector<ToolWarning> left = judge.all(warning.advised);
      const auto fresh = std::ranges::find_if(
          left, [&](const ToolWarning& one) { return one.code == warning.code || !has(warnings, one.code); });
      if (fresh == left.end()) break;
      if (fresh->code == warning.code || round == most_rounds) {
        warning.advice = "another tool: no feed rate and spindle speed of this machine suit this one";
        warning.advised = use;
        break;
      }
      warning.advice += ", with " + fresh->advice;
      warning.advised = fresh->advised;
    }
  }
  return warnings;
}

}  // namespace passo
