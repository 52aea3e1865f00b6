#include "passo/sender/grbl_target.hpp"

#include <cmath>

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
  target.measures_motors = machine.measures_motors();
  return target;
}

double GrblTarget::way(const Point& step) const {
  double squares = 0;
  for (const double part : step.values) squares += part * part;
  // The motors of a CoreXY move by x + y and x - y.
  if (measures_motors) squares += step[Axis::x] * step[Axis::x] + step[Axis::y] * step[Axis::y];
  return std::sqrt(squares);
}

}  // namespace passo
