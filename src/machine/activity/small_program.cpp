#include "small_program.hpp"

#include <algorithm>

namespace passo {

SmallProgram::SmallProgram(std::string_view purpose) {
  line("%");
  line("({})", comment_of(purpose));
  line("G21 G90 G94 G17 G40 G49");
  line("M5 (the spindle stays off)");
}

std::string SmallProgram::finish() {
  line("%");
  return std::move(text_);
}

std::optional<Sentence> outside_travel(const MachineDescription& machine, Axis axis, double place) {
  constexpr double rounding = 1e-6;  // mm
  constexpr SentenceRow outside{
      "goto.outside", "{axis} would go to {place} in machine coordinates, outside its travel of {low} to {high}"};
  const auto found = std::ranges::find(machine.axes, axis, &AxisDescription::axis);
  if (found == machine.axes.end() || (place >= found->travel_low - rounding && place <= found->travel_high + rounding))
    return {};
  return outside.with({{"axis", std::string(1, letter_of(axis))},
                       {"place", fmt::format("{:.3f}", place)},
                       {"low", fmt::format("{:g}", found->travel_low)},
                       {"high", fmt::format("{:g}", found->travel_high)}});
}

std::string comment_of(std::string_view text) {
  constexpr std::size_t longest = 120;
  std::string comment(text.substr(0, longest));
  std::ranges::replace_if(
      comment, [](char c) { return c < ' ' || c > '~' || c == '(' || c == ')' || c == '%'; }, '_');
  return comment;
}

}  // namespace passo
