#include "passo/sender/grbl_target.hpp"

namespace passo {

GrblTarget GrblTarget::of(const GrblMachine& machine) {
  GrblTarget target(first_work_zero(machine));
  AxisSet axes;
  for (const char letter : machine.axes) {
    if (const auto axis = axis_of(letter)) axes.add(*axis);
  }
  if (!axes.empty()) target.axes = axes;
  target.feed_way = machine.row().feed_way;
  target.has_mist = machine.has_mist();
  return target;
}

}  // namespace passo
