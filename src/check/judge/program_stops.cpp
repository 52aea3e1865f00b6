#include "passo/judge/program_stops.hpp"

#include <variant>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t most_told = 5;

std::string what(const OperatorWait& wait) {
  switch (wait.kind) {
    case Action::Kind::tool_change: return fmt::format("tool {} (M6)", wait.tool);
    case Action::Kind::optional_stop: return "optional stop (M1)";
    default: return wait.tool == 0 ? "program stop (M0)" : fmt::format("tool {} by hand (M0)", wait.tool);
  }
}

}  // namespace

std::string describe(const OperatorWait& wait) {
  std::string words = fmt::format("line {}: {}", wait.line, what(wait));
  if (wait.words.empty()) return words;
  words += ": " + wait.words;
  for (std::size_t end = 0; (end = words.find('\n', end)) != std::string::npos;) words.replace(end, 1, ", ");
  return words;
}

void ProgramStops::watch(const PathItem& item) {
  const auto* action = std::get_if<Action>(&item);
  if (action == nullptr) return;
  using Kind = Action::Kind;
  const bool stops =
      action->kind == Kind::program_stop || action->kind == Kind::optional_stop || action->kind == Kind::tool_change;
  if (!stops || action->by_machine) return;
  const std::uint32_t line = action->source.line;
  if (++count_ <= most_told) {
    stops_.push_back({.kind = action->kind, .tool = action->tool, .line = line, .words = words_.at(line)});
  }
  words_.pass(line);
}

std::string ProgramStops::words() const {
  std::string words;
  for (const OperatorWait& stop : stops_) words += (words.empty() ? "" : "; ") + describe(stop);
  if (count_ > most_told) words += fmt::format("; and {} more", count_ - most_told);
  return words;
}

}  // namespace passo
