// What the machine is set to, in words.
#include <cmath>

#include "block_in_words.hpp"
#include "reporter.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using Mode = Explanation::Mode;

std::string feed_of(const ProgramState& state) {
  if (state.feed == 0) return "none given";
  const double units = state.feed / state.length_unit();
  return fmt::format("{} {}{}", plain_number(units), state.modal.inches() ? "in" : "mm",
                     state.modal.per_revolution() ? "/rev" : "/min");
}

std::string spindle_of(const ProgramState& state) {
  if (state.spindles[0].direction == SpindleDirection::off) return "off";
  return fmt::format("{}, {} rev/min",
                     state.spindles[0].direction == SpindleDirection::clockwise ? "clockwise" : "counterclockwise",
                     plain_number(state.spindles[0].speed));
}

std::string coolant_of(const ProgramState& state) {
  if (state.mist && state.flood) return "mist and flood";
  return state.mist ? "mist" : state.flood ? "flood" : "off";
}

std::string tool_of(const ProgramState& state) {
  std::string text = state.tool == 0 ? std::string("none in the spindle") : fmt::format("{}", state.tool);
  if (state.selected_tool >= 0 && state.selected_tool != state.tool) {
    text += fmt::format("; {} is selected", state.selected_tool);
  }
  return text;
}

std::string overrides_of(const ProgramState& state) {
  if (state.feed_override == state.spindles[0].speed_override) return state.feed_override ? "on" : "off";
  return state.feed_override ? "of the feed only" : "of the spindle speed only";
}

std::string rotation_of(const ProgramState& state) {
  return number_and_noun(state.frame.rotation_degrees(), "degree");
}

// The settings that no code of a modal group tells.
struct Setting {
  const char* name;
  std::string (*of)(const ProgramState&);
  const char* usual;  // not shown while it is this; null: always shown
};
constexpr const char* no_offset = "X 0 mm, Y 0 mm, Z 0 mm";
const Setting shown_settings[] = {
    {"work offset", [](const ProgramState& state) { return in_words(state.frame.work_offset()); }, nullptr},
    {"G92 offset", [](const ProgramState& state) { return in_words(state.frame.g92_offset()); }, no_offset},
    {"rotation about Z", rotation_of, "0 degrees"},
    {"tool offset", [](const ProgramState& state) { return in_words(state.frame.tool_offset()); }, nullptr},
    {"feed", feed_of, nullptr},
    {"spindle", spindle_of, nullptr},
    {"coolant", coolant_of, nullptr},
    {"tool", tool_of, nullptr},
    {"overrides", overrides_of, "on"},
};

}  // namespace

std::string in_words(const Point& point) {
  std::string text;
  for (const Axis axis : all_axes) {
    const double value = std::round(point[axis] * 1e6) / 1e6 + 0.0;  // no "-0", no rounding errors
    if (axis > Axis::z && value == 0) continue;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} {}", letter_of(axis),
                        is_rotary(axis) ? number_and_noun(value, "degree") : plain_number(value) + " mm");
  }
  return text;
}

std::vector<Mode> modes_in_words(const ProgramState& before, const ProgramState& after) {
  std::vector<Mode> modes;
  for (const GroupRow& row : group_rows()) {
    if (row.sets.empty()) continue;
    const CodeNumber number = after.modal[row.group];
    const CodeEntry* const entry = find_code('G', number);
    modes.push_back({std::string(row.sets), spelling('G', number),
                     entry != nullptr ? std::string(entry->what) : std::string(), before.modal[row.group] != number});
  }
  for (const Setting& setting : shown_settings) {
    std::string now = setting.of(after);
    const bool set_here = setting.of(before) != now;
    if (setting.usual != nullptr && now == setting.usual && !set_here) continue;
    modes.push_back({setting.name, {}, std::move(now), set_here});
  }
  return modes;
}

}  // namespace passo
