// Plans a path within the limits of three axes, and prints the motion in time and the first steps of the motors.
#include <cstdio>

#include <passo/library.hpp>

int main() {
  passo::Limits limits;
  limits[passo::Axis::x] = {200, 1500, 30000};  // mm/s, mm/s², mm/s³
  limits[passo::Axis::y] = {200, 1500, 30000};
  limits[passo::Axis::z] = {50, 300};  // no jerk limit

  passo::Path path;  // starts at 0, 0, 0
  path.set_tolerance(0.02);
  passo::Position corner;
  corner.x = 60;
  path.line_to(corner, 100);
  corner.y = 40;
  path.line_to(corner, 100);
  corner.x = 20;
  path.arc_to(corner, passo::ArcPlane::xy, 40, 40, 1, 80);  // half a circle about (40, 40), counterclockwise
  path.stop(0.5);
  corner.z = -2;
  path.line_to(corner);

  const passo::Outcome<passo::Motion> motion = passo::plan(path, limits);
  if (!motion) {
    for (const passo::Finding& finding : motion.findings()) std::fputs(passo::describe(finding).c_str(), stderr);
    return 1;
  }
  std::printf("%.3f s, %.2f mm\n", motion->duration_s(), motion->length_mm());
  for (double time = 0; time < motion->duration_s(); time += 0.25) {
    const passo::MotionState state = motion->at(time);
    std::printf("%5.2f s  X %7.3f  Y %7.3f  Z %6.3f  %6.2f mm/s  piece %u\n", time, state.position.x, state.position.y,
                state.position.z, state.speed_mm_per_s, state.piece);
  }

  passo::StepOptions motors;
  motors[passo::Axis::x] = motors[passo::Axis::y] = 80;  // steps per mm
  motors[passo::Axis::z] = -400;                         // reversed direction
  passo::Outcome<passo::StepTrain> steps = motion->steps(motors);
  if (!steps) return 1;
  passo::Step first[5];
  const std::size_t count = steps->read(first, 5);
  for (std::size_t i = 0; i < count; ++i) {
    std::printf("%9.6f s  %c%c\n", static_cast<double>(first[i].tick) / steps->ticks_per_s(), letter_of(first[i].axis),
                first[i].forward ? '+' : '-');
  }
  return 0;
}
