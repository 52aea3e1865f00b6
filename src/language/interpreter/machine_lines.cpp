#include "machine_lines.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "passo/interpreter/saved_offsets.hpp"

namespace passo {

MachineLines::Before MachineLines::before() const {
  return {.depth = state_.call_depth,
          .tool = state_.tool,
          .selected = state_.selected_tool,
          .modes = snapshot_of(state_),
          .scaling = state_.scaling,
          .offsets = offsets()};
}

std::string MachineLines::put_back(const Before& before, std::int32_t next) {
  state_.scaling = before.scaling;
  if (state_.selected_tool != before.selected) {
    state_.selected_tool = before.selected;
    emit(operation::SelectTool{std::max(before.selected, 0)});
  }
  const Offsets now = offsets();
  const auto* const changed = std::ranges::mismatch(before.offsets, now).in2;
  if (changed != now.end()) {
    put_back(before.offsets);
    const int number = g92_active_parameter + static_cast<int>(changed - now.begin());
    if (number < work_system_parameter) return "has changed the offset of G92";
    return fmt::format("has changed the offset of {} (#{})",
                       name_of_system(1 + (number - work_offset_parameter(1)) / 20), number);
  }
  if (state_.tool == 0 || state_.tool == next || state_.tool == before.tool) return {};
  return fmt::format("has put tool {} into the spindle", state_.tool);
}

// The active system is a mode.
MachineLines::Offsets MachineLines::offsets() const {
  Offsets all{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int number = g92_active_parameter + static_cast<int>(i);
    if (number != work_system_parameter) all[i] = parameters_.get(number);
  }
  return all;
}

void MachineLines::put_back(const Offsets& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int number = g92_active_parameter + static_cast<int>(i);
    if (number != work_system_parameter) parameters_.set(number, all[i]);
  }
  frame_.start();
}

}  // namespace passo
