// Machines on which some axes have jerk limits, backlash or a start-stop velocity, and others none: no motion is slower
// than the limits ask for, and none exceeds a limit by more than digits.
#include <string>
#include <utility>

#include "kit/meddled_run.hpp"
#include "kit/random_gcode.hpp"

#include "passo/proof/proof_text.hpp"

namespace passo {
namespace {

MachineDescription table_of(std::initializer_list<Axis> axes, MmPerSecond velocity, MmPerSecond2 acceleration) {
  MachineDescription machine;
  for (const Axis axis : axes) {
    AxisDescription& own = machine.axes.emplace_back();
    own.axis = axis;
    own.steps_per_unit = 1000;
    own.travel_low = -2000;
    own.travel_high = 2000;
    own.velocity = velocity;
    own.acceleration = acceleration;
  }
  machine.board.highest_event_rate = Hertz(1e6);
  machine.path_tolerance = Mm(0.01);
  return machine;
}

MotionProof proof_of(const std::string& program, const MachineDescription& machine) {
  const test::Ending ending = test::run(program, machine, {.live = endless_commitment});
  for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
  return ending.proof;
}

// The rounded corner begins along X, and Y turns back where it begins, except for rounding. The path was cut there, and
// the piece of 1e-17 mm had no plan with the jerk of Y: the first line was slowed to 0.016 mm/s.
TEST(MixedMachine, passes_a_corner_that_begins_with_a_reversal) {
  const std::string program = "G21 G90 G64 F240\nG1 X30\nG1 X21 Y24\nM2\n";
  MachineDescription machine = table_of({Axis::x, Axis::y}, MmPerSecond(10), MmPerSecond2(300));
  machine.axes[1].jerk = MmPerSecond3(9000);
  const double without = proof_of(program, machine).time.value();
  machine.axes[1].screw = ScrewDescription{.backlash = 0.25};
  const MotionProof with = proof_of(program, machine);
  EXPECT_LT(with.times_bound(), 1.01);
  EXPECT_LT(with.time.value(), without + 1);  // two stops, and 0.25 mm twice
}

// Where only axes without a jerk limit move first, and the acceleration begins at once.
TEST(MixedMachine, starts_at_once_with_an_axis_without_a_jerk_limit) {
  MachineDescription machine = table_of({Axis::x, Axis::y}, MmPerSecond(50), MmPerSecond2(300));
  machine.axes[1].jerk = MmPerSecond3(3000);
  for (const double last : {0.2, 5.0, 40.0}) {
    const std::string program = fmt::format("G21 G90 G64 F9000\nG1 X40\nG1 X{} Y{}\nM2\n", 40 - last, last);
    EXPECT_LT(proof_of(program, machine).times_bound(), 1.05) << last;
  }
}

// The planner looked at few places of a cell, in which it took each third derivative for straight: 1.0010 of the jerk,
// 1.0006 of it, 1.0009 of the acceleration, and 1.0002 of the velocity of an axis that begins to turn.
TEST(MixedMachine, keeps_limits_between_the_places_looked_at) {
  for (const auto& [machines, number] : {std::pair{test::Machines::of_all_mixtures, 2654U},
                                         {test::Machines::mixed, 1129003329U},
                                         {test::Machines::mixed, 1129010325U},
                                         {test::Machines::of_all_mixtures, 5500441U}}) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(number));
    test::Random random = test::Random::of(number);
    const test::RandomJob job = test::RandomJob::of(machines, number, random);
    const MotionProof proof = proof_of(job.program, job.machine);
    for (const AxisProof& axis : proof.axes) {
      for (const auto& peak : {axis.velocity, axis.acceleration, axis.jerk}) EXPECT_LE(peak.multiple(), 1.0001);
    }
  }
}

}  // namespace
}  // namespace passo
