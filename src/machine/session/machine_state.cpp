#include "passo/session/machine_state.hpp"

#include <fmt/format.h>

namespace passo {

std::string_view name_of(MachineEvent event) {
  constexpr std::array<std::string_view, event_count> names = {
      "ready", "begin run",    "begin jog",  "begin home", "begin probe", "begin check",
      "hold",  "resume",       "want tool",  "want line",  "open door",   "close door",
      "end",   "stop at once", "lose board", "reset",      "fall asleep", "wake"};
  return names[static_cast<std::size_t>(event)];
}

namespace {

// Several events may lead from one state to another. One arrow stands for all of them.
std::string drawing() {
  std::string text = "```mermaid\nstateDiagram-v2\n  [*] --> Offline\n";
  for (const StateRow& from : state_rows) {
    for (const StateRow& to : state_rows) {
      std::string events;
      for (const Transition& one : transitions) {
        if (one.from != from.state || one.to != to.state) continue;
        events += fmt::format("{}{}", events.empty() ? "" : ", ", name_of(one.event));
      }
      if (!events.empty()) text += fmt::format("  {} --> {}: {}\n", from.name, to.name, events);
    }
  }
  return text + "```\n";
}

const char* yes_or_no(bool value) {
  return value ? "yes" : "no";
}

std::string rows() {
  std::string text = "| state | busy | motors may turn | outputs |\n|---|---|---|---|\n";
  for (const StateRow& row : state_rows) {
    text += fmt::format("| {} | {} | {} | {} |\n", row.name, yes_or_no(row.has_activity), yes_or_no(row.may_move),
                        row.program_has_outputs ? "as the program says" : "off");
  }
  return text;
}

std::string cells() {
  std::string text = "| state | event | next state |\n|---|---|---|\n";
  for (const Transition& one : transitions) {
    text += fmt::format("| {} | {} | {} |\n", name_of(one.from), name_of(one.event), name_of(one.to));
  }
  return text;
}

}  // namespace

std::string state_page() {
  return "# The states of a machine\n\n"
         "`MachineSession` follows one table, `transitions` in `session/machine_state.hpp`. This page is generated "
         "from the table. A\n"
         "test compares them; with `PASSO_UPDATE_GOLDEN=1` it writes the page again.\n\n" +
         drawing() + "\n## What is true in each state\n\n" + rows() + "\n## Each transition\n\n" + cells();
}

}  // namespace passo
