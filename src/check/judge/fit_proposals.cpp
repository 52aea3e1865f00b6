#include "passo/judge/fit_proposals.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/judge/check_page.hpp"

namespace passo {
namespace {

using Json = nlohmann::ordered_json;

struct Told {
  const char* kind = "";
  std::string words;
  Json values;  // more keys for programs
};

Told told(const proposal::WorkZeros& other) {
  std::string lines;
  Json zeros = Json::object();
  int system = 0;
  for (const auto& one : other.zeros) {
    if (one.system != system) lines += fmt::format("{}G10 L2 P{}", lines.empty() ? "" : ", ", one.system);
    system = one.system;
    lines += fmt::format(" {}{:.10g}", letter_of(one.axis), one.zero);
    zeros[name_of_system(system)][std::string(1, letter_of(one.axis))] = one.zero;
  }
  return {.kind = "work-zero",
          .words = "with another work zero, the program fits into the travel (checked): G21 " + lines,
          .values = {{"zeros", zeros}}};
}

Told told(const proposal::AxisTooShort& axis) {
  const char* const unit = is_rotary(axis.axis) ? "deg" : "mm";
  const std::string letter(1, letter_of(axis.axis));
  return {.kind = "axis-too-short",
          .words = fmt::format("{0} is too short by {1:.3f} {4}: the program needs {2:.3f} {4}, the travel has {3:.3f}",
                               letter, axis.needed - axis.travel, axis.needed, axis.travel, unit),
          .values = {{"axis", letter}, {"needed", axis.needed}, {"travel", axis.travel}}};
}

Told told(const proposal::Tools& tools) {
  std::string lines;
  for (const std::int32_t number : tools.numbers) {
    lines += fmt::format("{}T{} P{}", lines.empty() ? "" : ", ", number, number);
  }
  return {.kind = "tools",
          .words = fmt::format("with {} in the tool table, the program passes the check (checked with length and "
                               "diameter 0: add those of the real tool as Z and D): {}",
                               tools.numbers.size() == 1 ? "this tool" : "these tools", lines),
          .values = {{"tools", tools.numbers}}};
}

Told told(const proposal::SpindleForThread& spindle) {
  const double rpm = spindle.revolutions_per_minute;
  return {.kind = "spindle-speed",
          .words = fmt::format("with at most S{:g}, the axes can follow the spindle (checked)", rpm),
          .values = {{"spindle_rpm", rpm}, {"feed_percent", 100}}};
}

Told told(const proposal::SpindleAndFeed& spindle) {
  const double rpm = spindle.revolutions_per_minute;
  return {.kind = "spindle-speed",
          .words = fmt::format(
              "with at most S{:g} and the feeds at {} %, no tooth cuts more than programmed (checked): {} in motion",
              rpm, spindle.feed_percent, clock_words(spindle.motion)),
          .values = {{"spindle_rpm", rpm}, {"feed_percent", spindle.feed_percent}}};
}

Told told(const proposal::SlowerMotion& slower) {
  const bool feeds = slower.feed_percent < 100;
  const bool rapids = slower.rapid_percent < 100;
  const char* const what = feeds && rapids ? "feeds and rapids" : feeds ? "feeds" : "rapids";
  return {.kind = "override",
          .words = fmt::format("with {} at {} %, the motors lose no steps (checked)", what,
                               feeds ? slower.feed_percent : slower.rapid_percent),
          .values = {{"feed_percent", slower.feed_percent}, {"rapid_percent", slower.rapid_percent}}};
}

Told told(const Proposal& proposal) {
  return std::visit([](const auto& one) { return told(one); }, proposal);
}

}  // namespace

std::string to_text(const std::vector<Proposal>& proposals) {
  std::string text;
  for (const Proposal& proposal : proposals) text += fmt::format("proposal        {}\n", told(proposal).words);
  return text;
}

nlohmann::ordered_json as_json(const std::vector<Proposal>& proposals) {
  Json list = Json::array();
  for (const Proposal& proposal : proposals) {
    const Told one = told(proposal);
    Json json = {{"kind", one.kind}, {"words", one.words}};
    json.update(one.values);
    list.push_back(json);
  }
  return list;
}

}  // namespace passo
