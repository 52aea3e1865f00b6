// Hold, resume, override and stop at random instants: on the path, within the limits, and with nothing lost.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/meddled_run.hpp"
#include "kit/stage_test.hpp"

#include "passo/proof/motion_proof.hpp"
#include "passo/proof/proof_text.hpp"

namespace passo {
namespace {

using test::DrivenProgram;
using test::Ending;
using test::example_machine;
using test::Meddling;
using test::run;
using State = MotionDrive::State;

using test::with_jerk_limits;

// What a program is made of.
std::string lines() {
  return "G21 G90 G1 F4000\nX20\nY15\nX3 Y20 Z-2\nX0 Y0 Z0\nG61.1 X8 Y8\nX12\nG64 X-5 Y3\nG0 X0 Y0\nM2\n";
}
std::string arcs() {
  return "G21 G90 F5000\nG2 X20 Y0 I10 J0\nG3 X40 I10\nG2 X40 Y20 I0 J10\nG1 X30\nG3 X30 Y10 J-5 Z-3\nG2 X30.5 Y10 "
         "I.25\n"
         "G1 X10 Y10\nG3 I-3 Z0\nM2\n";
}
// Chords of a few hundredths to a few tenths of a millimetre, as CAM writes them.
std::string dense() {
  std::string text = "G21 G90 G64 P.02 F6000\n";
  double angle = 0;
  for (double at = 0; at < 40; angle += 0.04) {
    at += 0.05 + 0.04 * std::sin(3 * angle);
    text += "G1 X" + std::to_string(at) + " Y" + std::to_string(6 * std::sin(angle)) + " Z" +
            std::to_string(-std::fabs(std::sin(angle / 3))) + "\n";
  }
  return text + "M2\n";
}
std::string cycles() {
  return "G21 G90 S8000 M3 M8\nG98 G81 X5 Y5 Z-4 R2 F900\nX10\nX15 Y8\nG83 X20 Z-6 R1 Q2\nG82 X25 P.05 Z-1 R1\nG80 M5 "
         "M9\n"
         "G0 X0 Y0 Z5\nG4 P.1\nG1 Y10 F2000\nM2\n";
}

void expect_nothing_lost(const std::string& program, const MachineDescription& machine, int runs) {
  SCOPED_TRACE(machine.name);
  test::Random random;
  test::Acts acts;
  const Ending undisturbed = run(program, machine);
  EXPECT_TRUE(undisturbed.proof.good()) << to_text(undisturbed.proof);
  for (int i = 0; i < runs && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("run " + std::to_string(i));
    Meddling meddling{.random = random, .acts = acts};
    const Ending ending = run(program, machine, {.meddling = &meddling});
    EXPECT_TRUE(ending.proof.good()) << to_text(ending.proof);
    for (std::size_t m = 0; m < machine.axes.size(); ++m) {
      EXPECT_EQ(ending.motors[m].position, undisturbed.motors[m].position) << "motor " << m;
    }
  }
  acts.print();
}

constexpr std::array<const char*, 4> machines = {"bench", "router", "pantograph", "forty-eight"};

TEST(MidRun, holds_and_overrides_lose_nothing_on_lines) {
  for (const char* machine : machines) expect_nothing_lost(lines(), example_machine(machine), 2);
}
TEST(MidRun, holds_and_overrides_lose_nothing_on_arcs) {
  for (const char* machine : machines) expect_nothing_lost(arcs(), example_machine(machine), 1);
}
TEST(MidRun, holds_and_overrides_lose_nothing_on_dense_paths) {
  for (const char* machine : machines) expect_nothing_lost(dense(), example_machine(machine), 1);
}
TEST(MidRun, holds_and_overrides_lose_nothing_in_cycles) {
  for (const char* machine : machines) expect_nothing_lost(cycles(), example_machine(machine), 2);
}

TEST(MidRun, holds_and_overrides_lose_nothing_where_the_jerk_is_limited) {
  for (const char* name : {"bench", "router", "forty-eight"}) {
    const MachineDescription machine = with_jerk_limits(example_machine(name));
    for (const std::string& program : {lines(), arcs(), dense(), cycles()}) expect_nothing_lost(program, machine, 1);
  }
}

// The steps of all motors, as the virtual machine made them.
class Steps final : public MachineObserver {
 public:
  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override {
    times.push_back(time.count);
    motors.push_back(stepped | directions << 8);
  }
  std::vector<std::int64_t> times;
  std::vector<int> motors;
};

struct Reaction {
  double committed = 0;  // at the hold, as the drive says
  double seen = -1;      // from the hold to the first step that is later than without it; -1: none was
};

// Runs once as it is and once with a hold at `at`, and compares the steps.
Reaction reaction_to_hold(const std::string& program, const MachineDescription& machine, double at) {
  Reaction reaction;
  std::array<Steps, 2> steps;
  double asked = 0;
  for (const bool held : {false, true}) {
    Diagnostics diagnostics;
    DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics,
                      {.live = live_commitment});
    job.machine().add_observer(steps[held ? 1 : 0]);
    MotionDrive& drive = job.drive();
    while (job.advance() && drive.state() != State::held) {
      if (!held || asked > 0 || drive.now().value() < at) continue;
      drive.hold();
      asked = drive.now().value();
      reaction.committed = drive.committed().value();
    }
  }
  // The board segments are others from the hold on, so that a step may fall a tick beside where it was.
  constexpr std::int64_t rounding = 4;
  for (std::size_t i = 0; i < std::min(steps[0].times.size(), steps[1].times.size()); ++i) {
    if (std::abs(steps[1].times[i] - steps[0].times[i]) <= rounding) continue;
    reaction.seen = static_cast<double>(steps[1].times[i]) / machine.board.clock.value() - asked;
    break;
  }
  return reaction;
}

TEST(MidRun, a_hold_slows_the_machine_within_10_ms_beyond_what_is_committed) {
  test::Random random;
  for (std::size_t n = 0; n < 2 * machines.size(); ++n) {
    const char* name = machines[n / 2];
    const bool jerk = n % 2 == 1;
    const MachineDescription machine = jerk ? with_jerk_limits(example_machine(name)) : example_machine(name);
    double most_committed = 0;
    double most_seen = 0;
    double most_beyond = 0;
    // Where the speed is even: the machine slows for the hold and for nothing else.
    for (const char* program : {"G21 G90 G1 X100 F1200\nM2\n", "G21 G90 G2 I40 F900\nM2\n"}) {
      for (int i = 0; i < 3; ++i) {
        const Reaction reaction = reaction_to_hold(program, machine, random.between(1, 4));
        EXPECT_LE(reaction.committed, live_commitment.horizon.value() + 3 * live_commitment.longest_move.value());
        EXPECT_GT(reaction.seen, 0) << name;
        EXPECT_LE(reaction.seen, reaction.committed + 0.010) << name;
        most_committed = std::max(most_committed, reaction.committed);
        most_seen = std::max(most_seen, reaction.seen);
        if (reaction.seen > 0) most_beyond = std::max(most_beyond, reaction.seen - reaction.committed);
      }
    }
    std::printf(
        "%-12s%s committed at most %.1f ms, slower after at most %.1f ms, at most %.1f ms beyond what was committed\n",
        name, jerk ? " with jerk" : "", most_committed * 1e3, most_seen * 1e3, most_beyond * 1e3);
  }
}

TEST(MidRun, a_stop_ends_at_rest_on_the_path_with_the_outputs_off_and_the_place_known) {
  test::Random random;
  const MachineDescription machine = example_machine("router");
  for (const std::string& program : {lines(), arcs(), dense(), cycles()}) {
    for (int i = 0; i < 5; ++i) {
      Diagnostics diagnostics;
      DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics,
                        {.live = live_commitment});
      MotionDrive& drive = job.drive();
      Point place;
      double speed = 0;
      job.motion().watch([&](const MotionItem& item) {
        const auto* move = std::get_if<PlannedMove>(&item);
        if (move == nullptr) return;
        place = move->segment.curve.at(move->to);
        speed = move->exit_velocity().value();
      });
      const double at = random.between(0.05, 2);
      while (job.advance()) {
        if (drive.now().value() >= at) drive.stop();
      }
      EXPECT_EQ(drive.state(), State::ended);
      EXPECT_NEAR(speed, 0, 1e-6);
      const MachineCounts counts = job.machine().counts();
      EXPECT_EQ(counts.outputs.switches, 0);
      for (std::size_t m = 0; m < machine.axes.size(); ++m) {
        const AxisDescription& axis = machine.axes[m];
        const double steps = place[axis.axis] * (axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit);
        EXPECT_NEAR(static_cast<double>(counts.motors[m].position), steps, 0.5 + 1e-6);
      }
    }
  }
}

TEST(MidRun, a_drive_at_rest_is_held_at_once_and_goes_on) {
  Diagnostics diagnostics;
  DrivenProgram job(ProgramReader::from_text("t", lines()), example_machine("router"), InterpreterOptions(),
                    diagnostics);
  MotionDrive& drive = job.drive();
  drive.hold();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(job.advance());
  EXPECT_EQ(drive.state(), State::held);
  EXPECT_EQ(drive.now().value(), 0);
  drive.resume();
  while (job.advance()) {
  }
  EXPECT_EQ(drive.state(), State::ended);
}

// What M48 to M53 say of changes in mid-run.
class Switched {
 public:
  explicit Switched(const std::string& program, bool jerk = false)
      : machine_(jerk ? with_jerk_limits(example_machine("router")) : example_machine("router")),
        job_(ProgramReader::from_text("t", program), machine_, InterpreterOptions(), diagnostics_,
             {.live = live_commitment}) {}
  MotionDrive& drive() { return job_.drive(); }
  const VirtualMachine& machine() { return job_.machine(); }
  // To the time, or to the end.
  void run_to(double time = 1e9) {
    while (drive().now().value() < time && drive().state() != State::held && job_.advance()) {
    }
  }
  double time() { return drive().now().value(); }
  double x() {
    return static_cast<double>(job_.machine().counts().motors[0].position) / machine_.axes[0].steps_per_unit;
  }

 private:
  MachineDescription machine_;
  Diagnostics diagnostics_;
  DrivenProgram job_;
};

TEST(MidRunSwitches, feed_overrides_count_between_m50_and_m50_p0_only) {
  for (const bool jerk : {false, true}) {
    Switched free("G21 G1 X20 F600\nM2\n", jerk);
    free.drive().set_feed_override(0.5);
    free.run_to();
    EXPECT_NEAR(free.time(), 4, 0.1);
    for (const char* off : {"M50 P0", "M49"}) {
      Switched fixed("G21 " + std::string(off) + "\nG1 X20 F600\nM2\n", jerk);
      fixed.drive().set_feed_override(0.5);
      fixed.run_to();
      EXPECT_NEAR(fixed.time(), 2, 0.1);
    }
    Switched both("G21 M49\nG1 X20 F600\nM48\nX40\nM2\n", jerk);
    both.drive().set_feed_override(0.5);
    both.run_to();
    EXPECT_NEAR(both.time(), 6, 0.2);
  }
}

TEST(MidRunSwitches, adaptive_feed_counts_with_m52_only) {
  for (const bool on : {false, true}) {
    Switched run("G21 M52 P" + std::string(on ? "1" : "0") + "\nG1 X20 F600\nM2\n");
    run.drive().set_adaptive_feed(0.25);
    run.run_to();
    EXPECT_NEAR(run.time(), on ? 8 : 2, 0.1);
  }
}

// As in LinuxCNC, adaptive feed applies to rapids too. The feed override does not.
TEST(MidRunSwitches, adaptive_feed_slows_rapids_down_too) {
  for (const bool jerk : {false, true}) {
    std::array<double, 3> times{};
    for (const int way : {0, 1, 2}) {
      Switched run("G21 M52 P" + std::string(way == 1 ? "1" : "0") + "\nG0 X40\nM2\n", jerk);
      if (way > 0) run.drive().set_adaptive_feed(0.1);
      run.run_to();
      times[static_cast<std::size_t>(way)] = run.time();
    }
    EXPECT_EQ(times[2], times[0]);
    EXPECT_GT(times[1], 5 * times[0]);
    Switched stopped("G21 M52 P1\nG0 X40\nM2\n", jerk);
    stopped.drive().set_adaptive_feed(0);
    stopped.run_to();
    EXPECT_EQ(stopped.drive().state(), State::held);
    EXPECT_EQ(stopped.x(), 0);
  }
}

TEST(MidRunSwitches, adaptive_feed_multiplies_with_the_override) {
  Switched run("G21 M52 P1\nG1 X20 F600\nM2\n");
  run.drive().set_adaptive_feed(0.5);
  run.drive().set_feed_override(0.5);
  run.run_to();
  EXPECT_NEAR(run.time(), 8, 0.1);
}

TEST(MidRunSwitches, a_feed_of_nothing_stands_until_there_is_more) {
  for (const bool jerk : {false, true}) {
    Switched run("G21 G1 X20 F600\nM2\n", jerk);
    run.run_to(1);
    run.drive().set_feed_override(0);
    run.run_to();
    EXPECT_EQ(run.drive().state(), State::held);
    EXPECT_LT(run.x(), 11.5);
    test::let_pass(run.drive(), Seconds(1));
    run.drive().set_feed_override(1);
    run.run_to();
    EXPECT_EQ(run.drive().state(), State::ended);
    EXPECT_NEAR(run.x(), 20, 1e-9);
    EXPECT_NEAR(run.time(), 3.1, 0.1);
  }
}

TEST(MidRunSwitches, a_hold_waits_for_the_end_of_m53_p0) {
  for (const bool jerk : {false, true}) {
    Switched run("G21 M53 P0\nG1 X10 F600\nM53 P1\nX20\nM2\n", jerk);
    run.run_to(0.3);
    run.drive().hold();
    run.run_to();
    EXPECT_EQ(run.drive().state(), State::held);
    EXPECT_GT(run.x(), 10);
    EXPECT_LT(run.x(), 10.5);
    run.drive().resume();
    run.run_to();
    EXPECT_NEAR(run.x(), 20, 1e-9);
  }
}

TEST(MidRunSwitches, a_stop_waits_for_nothing) {
  Switched run("G21 M53 P0\nG1 X10 F600\nM2\n");
  run.run_to(0.3);
  run.drive().stop();
  run.run_to();
  EXPECT_EQ(run.drive().state(), State::ended);
  EXPECT_LT(run.x(), 5);
}

TEST(MidRunSwitches, a_spindle_override_counts_behind_what_is_committed_and_not_after_m51_p0) {
  Switched run("G21 S1000 M3\nG1 X10 F600\nM51 P0\nX20\nM2\n");
  run.run_to(0.3);
  EXPECT_EQ(run.machine().counts().outputs.spindle_rpm, 1000);
  run.drive().set_spindle_override(1.2);
  run.run_to(0.5);
  EXPECT_EQ(run.machine().counts().outputs.spindle_rpm, 1200);
  run.run_to(1.5);
  EXPECT_EQ(run.machine().counts().outputs.spindle_rpm, 1000);
  run.run_to();
  EXPECT_EQ(run.machine().counts().outputs.spindle_rpm, 0);
}

}  // namespace
}  // namespace passo
