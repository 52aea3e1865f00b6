#include "passo/library/check.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo::v1 {
namespace {

std::string machine_file(const std::string& name) {
  return std::string(PASSO_SOURCE_DIR) + "/examples/machines/" + name;
}

Machine pantograph() {
  return Machine::open(machine_file("pantograph.toml")).value();
}

TEST(Machine, gives_its_limits_and_motors) {
  const Machine machine = pantograph();
  EXPECT_EQ(machine.name(), "Pantograph router");
  EXPECT_THAT(machine.axes(), testing::ElementsAre(Axis::x, Axis::y, Axis::z));
  EXPECT_EQ(machine.limits()[Axis::z].velocity_mm_per_s, 15);
  EXPECT_EQ(machine.limits()[Axis::a].velocity_mm_per_s, 0);
  EXPECT_EQ(machine.step_options().steps_per_mm[0], 100);
  EXPECT_FALSE(machine.knows_motors());
  EXPECT_TRUE(Machine::open(machine_file("strong-router.toml")).value().knows_motors());
}

TEST(Machine, that_is_wrong_says_all_of_it) {
  const Outcome<Machine> machine = Machine::from_text("name = 3\n[axis.X]\nvelocity = 1\n", "mine.toml");
  ASSERT_FALSE(machine);
  EXPECT_GE(machine.findings().size(), 2U);
  EXPECT_EQ(machine.findings().front().file, "mine.toml");
  EXPECT_THAT(machine.findings().front().code, testing::StartsWith("machine."));
  EXPECT_FALSE(Machine::open("/nowhere/machine.toml"));
}

TEST(Check, tells_time_extents_and_what_limits_the_speed) {
  // 100 mm at 10 mm/s, from rest to rest with 200 mm/s².
  const Program program = Program::from_text("G21 G90 G17\nG1 X100 F600\nM2\n");
  const ProgramReport report = check(program, pantograph());
  ASSERT_TRUE(report.good());
  ASSERT_TRUE(report.motion);
  EXPECT_NEAR(report.motion->cutting_time_s, 100.0 / 10 + 10.0 / 200, 1e-6);
  EXPECT_EQ(report.motion->time_s(), report.motion->cutting_time_s);
  EXPECT_EQ(report.motion->moves, 1U);
  ASSERT_EQ(report.motion->axes.size(), 3U);
  EXPECT_EQ(report.motion->axes[0].extents->high, 100);
  EXPECT_NEAR(report.motion->axes[0].highest_mm_per_s, 10, 1e-9);
  EXPECT_EQ(report.motion->axes[1].extents->high, 0);
  ASSERT_FALSE(report.motion->speed_limits.empty());
  EXPECT_EQ(report.motion->speed_limits[0].limit, "the programmed feed");
  EXPECT_FALSE(report.motion->motors);

  const ProgramReport slower = check(program, pantograph(), {.feed_factor = 0.5});
  EXPECT_NEAR(slower.motion->cutting_time_s, 100.0 / 5 + 5.0 / 200, 1e-6);
  EXPECT_FALSE(check(program, pantograph(), {.plans = false}).motion);
}

TEST(Check, gives_errors_with_their_places) {
  const ProgramReport report = check(Program::from_text("G21 G90\nG1 X1000 F600\nM2\n", "far.ngc"), pantograph());
  EXPECT_FALSE(report.good());
  EXPECT_FALSE(report.motion);
  ASSERT_EQ(report.findings.size(), 2U);
  EXPECT_EQ(report.findings[0].severity, Severity::warning);  // the spindle is off
  EXPECT_EQ(report.findings[1].code, "travel.exceeded");
  EXPECT_EQ(report.findings[1].line, 2U);
  EXPECT_EQ(report.findings[1].column, 4U);
  EXPECT_EQ(report.findings[1].length, 5U);
  EXPECT_FALSE(check(Program::from_text("M2\n"), pantograph(), {.feed_factor = 7}).good());
}

// 200 kg on a small motor.
Machine heavy_axis(int acceleration) {
  const std::string text = R"(name = "Heavy"
[board]
clock_hz = 16_000_000
max_event_rate_hz = 100_000
[axis.X]
steps_per_turn = 200
microsteps = 8
screw_pitch_mm = 4
travel_mm = [-100, 100]
max_velocity_mm_s = 50
[axis.X.torque]
limits_motion = false
holding_torque_nm = 0.45
rated_current_a = 1.7
resistance_ohm = 1.5
inductance_mh = 2.8
supply_v = 24
rotor_inertia_g_cm2 = 68
load_mass_kg = 200
friction_n = 100
)";
  const std::string limit = "max_velocity_mm_s = 50\n";
  std::string whole = text;
  whole.insert(whole.find(limit) + limit.size(), "max_acceleration_mm_s2 = " + std::to_string(acceleration) + "\n");
  const Outcome<Machine> machine = Machine::from_text(whole);
  for (const Finding& finding : machine.findings()) ADD_FAILURE() << describe(finding);
  return machine.value();
}

TEST(Check, tells_lost_steps_with_line_cause_and_cure) {
  const Program program = Program::from_text("G21 G90\nG0 X30\nG1 X-30 F300\nM2\n");
  const ProgramReport gentle = check(program, heavy_axis(100));
  ASSERT_TRUE(gentle.motion);
  EXPECT_EQ(gentle.motion->motors, StepVerdict::safe);
  EXPECT_TRUE(gentle.motion->weak_spots.empty());
  const ProgramReport wild = check(program, heavy_axis(4000));
  ASSERT_TRUE(wild.motion);
  EXPECT_TRUE(wild.good());  // the program itself has no error
  EXPECT_EQ(wild.motion->motors, StepVerdict::lost);
  ASSERT_FALSE(wild.motion->weak_spots.empty());
  const WeakSpot& worst = wild.motion->weak_spots.front();
  EXPECT_EQ(worst.axis, Axis::x);
  EXPECT_EQ(worst.line, 2U);
  EXPECT_GT(worst.load, 1);
  EXPECT_THAT(worst.cause, testing::StartsWith("X needs "));
  EXPECT_THAT(worst.cure, testing::HasSubstr("a <= "));
}

TEST(Check, calls_progress_up_to_one_and_lets_it_end_the_call) {
  std::string text = "G21 G90\n";
  for (int i = 0; i < 6000; ++i) text += i % 2 == 0 ? "G1 X10 F600\n" : "G1 X0 Y1\nG1 Y0\n";
  const Program program = Program::from_text(text + "M2\n");
  double last = 0;
  int calls = 0;
  const auto watch = [&](double share) {
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1);
    last = share;
    ++calls;
  };
  check(program, pantograph(), {.progress = watch});
  EXPECT_EQ(last, 1);
  EXPECT_GT(calls, 5);
  for (const double end : {0.1, 0.6}) {
    const auto stop = [&](double share) {
      if (share > end) throw std::runtime_error("enough");
    };
    EXPECT_THROW(check(program, pantograph(), {.progress = stop}), std::runtime_error);
    EXPECT_THROW(static_cast<void>(plan(program, pantograph(), {.progress = stop})), std::runtime_error);
  }
}

TEST(PlannedProgram, is_the_motion_that_the_check_measured) {
  const Program program = Program::open(std::string(PASSO_SOURCE_DIR) + "/examples/engrave.ngc").value();
  const ProgramReport report = check(program, pantograph());
  ASSERT_TRUE(report.motion);
  const Outcome<Motion> motion = plan(program, pantograph());
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->duration_s(), report.motion->time_s(), 1e-6 * report.motion->time_s());
  EXPECT_NEAR(motion->length_mm(), report.motion->cutting_length_mm + report.motion->rapid_length_mm, 1e-6);
  EXPECT_GT(motion->at(motion->duration_s() / 2).piece, 20U);

  Outcome<StepTrain> steps = motion->steps();
  ASSERT_TRUE(steps);
  std::vector<Step> block(10'000);
  std::array<std::int64_t, 3> counts{};
  for (std::size_t count = 1; count > 0;) {
    count = steps->read(block.data(), block.size());
    for (std::size_t i = 0; i < count; ++i) {
      counts.at(static_cast<std::size_t>(block[i].axis)) += block[i].forward ? 1 : -1;
    }
  }
  const Position end = motion->at(motion->duration_s()).position;
  EXPECT_NEAR(static_cast<double>(counts[0]), end.x * 100, 0.51);
  EXPECT_NEAR(static_cast<double>(counts[1]), end.y * 100, 0.51);
  EXPECT_NEAR(static_cast<double>(counts[2]), end.z * 100, 0.51);
}

TEST(PlannedProgram, with_errors_has_no_motion) {
  const Outcome<Motion> motion = plan(Program::from_text("G1 X1\nM2\n"), pantograph());
  ASSERT_FALSE(motion);
  EXPECT_EQ(motion.findings().front().code, "gcode.missing-feed");
}

TEST(PlannedProgram, of_a_machine_with_backlash_ends_where_it_should) {
  const Outcome<Machine> machine = Machine::from_text(R"(name = "Loose"
[board]
clock_hz = 16_000_000
max_event_rate_hz = 50_000
[axis.X]
steps_per_mm = 100
travel_mm = [-50, 50]
max_velocity_mm_s = 20
max_acceleration_mm_s2 = 200
[axis.X.screw]
backlash_mm = 0.2
)");
  ASSERT_TRUE(machine) << describe(machine.findings().front());
  const Outcome<Motion> motion = plan(Program::from_text("G21 G90\nG1 X10 F600\nX5\nX8\nM2\n"), *machine);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->length_mm(), 10 + 5 + 3, 1e-9);
  EXPECT_EQ(motion->steps(machine->step_options()).findings().front().code, "steps.backlash");
  Outcome<StepTrain> steps = motion->steps();
  ASSERT_TRUE(steps);
  std::vector<Step> all(10'000);
  all.resize(steps->read(all.data(), all.size()));
  std::int64_t net = 0;
  for (const Step& step : all) net += step.forward ? 1 : -1;
  EXPECT_EQ(net, 800);
  EXPECT_EQ(all.size(), 1800U + 2 * 20);  // the motor takes up 0.2 mm twice
}

}  // namespace
}  // namespace passo::v1
