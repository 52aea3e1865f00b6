#include "passo/activity/placed_tool_change.hpp"

#include <variant>

namespace passo {
namespace {

constexpr SentenceRow unplaced{"run.tool-change-unplaced",
                               "M6 goes to machine coordinates, and the machine was not homed: home it, or confirm "
                               "its position"};

}  // namespace

bool is_placed_tool_change(const Operation& operation, const MachineDescription& machine) {
  return machine.tool_change != nullptr && std::holds_alternative<operation::StartToolChange>(operation.what);
}

Sentence sentence_of_unplaced_tool_change() {
  return unplaced.with();
}

Diagnostic unplaced_tool_change(const std::string& file, std::uint32_t line) {
  const Sentence why = sentence_of_unplaced_tool_change();
  return {.code = why.code,
          .file = file,
          .place = {.line = line, .column = 0, .length = 1},
          .message = why.text,
          .expected = {},
          .text = {}};
}

}  // namespace passo
