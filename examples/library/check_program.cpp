// Checks a program for a machine: errors, time, extents, what limits the speed, and whether the motors lose steps.
#include <cstdio>

#include <passo/library.hpp>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("check_program PROGRAM MACHINE\n", stderr);
    return 2;
  }
  const passo::Outcome<passo::Program> program = passo::Program::open(argv[1]);
  const passo::Outcome<passo::Machine> machine = passo::Machine::open(argv[2]);
  for (const passo::Finding& finding : program.findings()) std::fputs(passo::describe(finding).c_str(), stderr);
  for (const passo::Finding& finding : machine.findings()) std::fputs(passo::describe(finding).c_str(), stderr);
  if (!program || !machine) return 2;

  const passo::ProgramReport report = passo::check(*program, *machine);
  for (const passo::Finding& finding : report.findings) std::fputs(passo::describe(finding).c_str(), stderr);
  if (!report.good()) return 2;
  const passo::MotionReport& motion = *report.motion;
  std::printf("%.2f s, %llu moves\n", motion.time_s(), static_cast<unsigned long long>(motion.moves));
  for (const passo::AxisMotion& axis : motion.axes) {
    if (axis.extents) std::printf("%c: %g to %g mm\n", letter_of(axis.axis), axis.extents->low, axis.extents->high);
  }
  for (const passo::SpeedLimit& limit : motion.speed_limits) {
    std::printf("%.2f s limited by %s, first in line %u\n", limit.time_s, limit.limit.c_str(), limit.first_line);
  }
  if (!motion.motors) {
    std::puts("motors: not described");
  } else if (*motion.motors == passo::StepVerdict::safe) {
    std::puts("motors: safe");
  }
  for (const passo::WeakSpot& spot : motion.weak_spots) {
    std::printf("line %u: %s\n  %s\n", spot.line, spot.cause.c_str(), spot.cure.c_str());
  }
  return 0;
}
