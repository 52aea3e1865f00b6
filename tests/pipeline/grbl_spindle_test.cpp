// A sender's lines and the spindle: motion waits until it has run up, and a thread that an axis cannot follow is
// refused.
#include <string>

#include "pipeline/grbl_kit.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::GrblRun;

MachineDescription router_that_runs_up() {
  MachineDescription machine = test::example_machine("router");
  machine.spindle.run_up = Seconds(0.5);
  return machine;
}

double x_of(GrblRun& run) {
  return run.session().status().now_at[Axis::x];
}

TEST(GrblSpindle, motion_waits_until_the_spindle_has_run_up) {
  GrblRun run(router_that_runs_up());
  run.send("M3 S4000\nG1 X10 F6000\n");
  run.pass(Seconds(1.9));
  EXPECT_EQ(x_of(run), 0);
  run.pass(Seconds(1));
  EXPECT_NEAR(x_of(run), 10, 1e-3);
  run.send("M3 S4000\nG1 X20\n");
  run.pass(Seconds(0.6));
  EXPECT_NEAR(x_of(run), 20, 1e-3) << "at that speed already";
}

TEST(GrblSpindle, a_spindle_that_was_stopped_in_a_hold_runs_up_again) {
  MachineDescription machine = router_that_runs_up();
  machine.silence.spindle_wait = Seconds(1);
  GrblRun run(machine);
  run.send("M3 S4000\nG1 X100 F600\n");
  run.pass(Seconds(4));
  run.send("!");
  run.pass(Seconds(1));
  const double held = x_of(run);
  EXPECT_GT(held, 5);
  run.send("\x9e");
  run.pass(Seconds(1));
  EXPECT_EQ(run.board().counts().outputs.switches, 0);
  run.send("~");
  run.pass(Seconds(1.9));
  EXPECT_NE(run.board().counts().outputs.switches, 0);
  EXPECT_NEAR(x_of(run), held, 1e-3) << "longer than spindle_wait_s";
  run.pass(Seconds(1));
  EXPECT_GT(x_of(run), held + 1);
}

TEST(GrblSpindle, a_spindle_that_was_started_again_in_a_hold_runs_up_before_the_resume) {
  GrblRun run(router_that_runs_up());
  run.send("M3 S4000\nG1 X100 F600\n");
  run.pass(Seconds(4));
  run.send("!");
  run.pass(Seconds(1));
  const double held = x_of(run);
  run.send("\x9e");
  run.pass(Seconds(1));
  run.send("\x9e~");
  run.pass(Seconds(1.8));
  EXPECT_NEAR(x_of(run), held, 1e-3);
  run.pass(Seconds(1));
  EXPECT_GT(x_of(run), held + 1);
}

TEST(GrblSpindle, the_drivers_have_their_time_before_the_first_motion) {
  MachineDescription machine = test::example_machine("router");
  machine.pins.enable_wait = Seconds(2);
  GrblRun run(machine);
  run.send("G0 X10\n");
  run.pass(Seconds(1.5));
  EXPECT_EQ(x_of(run), 0);
  run.pass(Seconds(1.5));
  EXPECT_NEAR(x_of(run), 10, 1e-3);
}

TEST(OpenProgramOf, a_thread_that_an_axis_cannot_follow_is_refused_each_time) {
  const MachineDescription machine = test::example_machine("router");
  StreamedProgram program(machine, InterpreterOptions(), Point());
  EXPECT_FALSE(program.add_line("G21 G90 M3 S6000", Seconds(0)));
  for (int i = 0; i < 2; ++i) {
    const std::size_t queued = program.queued();
    const auto refused = program.add_line("G33 Z-15 K4", Seconds(0));
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->code, "path.thread-too-fast");
    EXPECT_EQ(program.queued(), queued);
  }
  EXPECT_FALSE(program.add_line("G33 Z-15 K0.5", Seconds(0)));
}

}  // namespace
}  // namespace passo
