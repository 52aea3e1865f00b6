#include "core_xy_check.hpp"

#include <vector>

#include <fmt/format.h>

namespace passo {
namespace {

const char* const core_xy_code = "machine.kinematics";

// The table that describes a motor of the axis alone. Null: there is none.
const char* table_of_own_motor(const AxisDescription& axis) {
  if (axis.second) return "second_motor";
  if (axis.motor) return "torque";
  if (axis.screw) return "screw";
  return axis.encoder ? "encoder" : nullptr;
}

void check_axis(const TomlReporter& reporter, const PlacedAxis& placed) {
  const char* const table = table_of_own_motor(placed.axis);
  if (table == nullptr) return;
  const char letter = letter_of(placed.axis.axis);
  reporter.error(
      core_xy_code, placed.place, fmt::format("[axis.{}.{}] describes a motor of its own", letter, table),
      fmt::format("no such table: {} shares two motors of a CoreXY with {}", letter, letter == 'X' ? 'Y' : 'X'));
}

}  // namespace

void check_core_xy(const TomlReporter& reporter, const SourceLocation& key, MachineUse use,
                   std::span<const PlacedAxis> axes, bool is_complete) {
  if (use == MachineUse::own_board) {
    reporter.error(core_xy_code, key,
                   "the boards of Passo, its simulated machine and its planner do not support a CoreXY",
                   "a board with Grbl: --board grbl:DEVICE, and passo check --board grbl");
  }
  std::vector<const PlacedAxis*> shared;
  for (const PlacedAxis& placed : axes) {
    if (placed.axis.axis != Axis::x && placed.axis.axis != Axis::y) continue;
    check_axis(reporter, placed);
    shared.push_back(&placed);
  }
  if (shared.size() < 2) {
    if (is_complete) reporter.error(core_xy_code, key, "a CoreXY has the axes X and Y", "[axis.X] and [axis.Y]");
    return;
  }
  const AxisDescription& first = shared[0]->axis;
  const AxisDescription& second = shared[1]->axis;
  if (first.steps_per_unit == second.steps_per_unit) return;
  reporter.error(core_xy_code, shared[1]->place,
                 fmt::format("{} has {:g} steps per mm and {} has {:g}", letter_of(first.axis), first.steps_per_unit,
                             letter_of(second.axis), second.steps_per_unit),
                 "the same number for X and Y, which share the two motors of a CoreXY");
}

}  // namespace passo
