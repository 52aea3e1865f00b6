// Threads and feeds a revolution follow the spindle as it turns, not as it was told to.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/spindle_kit.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::Cut;
using test::groove;
using test::grooves_at;
using test::ideal;
using test::lathe;
using test::play;
using test::Played;
using test::rippling;
using test::Spread;
using test::spread;
using test::thread_program;

Played run(const std::string& program, const MachineDescription& machine, bool both_ways = false) {
  const Played played = play(program, machine, test::DriveOn(), both_ways);
  EXPECT_FALSE(played.error);
  return played;
}

TEST(SpindleFollowing, a_thread_has_its_pitch_though_the_spindle_ripples_by_5_percent) {
  for (const bool jerk : {false, true}) {
    const double even = spread(run(thread_program("600"), lathe(ideal, jerk)).cuts, 1.5, -4, -19).mm(1.5);
    const double uneven = spread(run(thread_program("600"), lathe(rippling, jerk)).cuts, 1.5, -4, -19).mm(1.5);
    SpindleDescription blind = rippling;
    blind.counts_per_turn = 0;
    const double unfollowed = spread(run(thread_program("600"), lathe(blind, jerk)).cuts, 1.5, -4, -19).mm(1.5);
    std::printf("%s: along 10 turns the groove wanders %.4f mm, without ripple %.4f mm, without encoder %.4f mm\n",
                jerk ? "with jerk limit" : "without", uneven, even, unfollowed);
    EXPECT_LT(even, 0.01);
    EXPECT_LT(uneven, jerk ? 0.03 : 0.015);
    EXPECT_GT(unfollowed, 0.4);
  }
}

TEST(SpindleFollowing, several_passes_cut_the_same_groove) {
  const std::string pass = "G0 X0 Z0\nG33 Z-12 K1.5\nG0 X2\nZ0\n";
  std::string program = "G21 G61.1 S600 M3\n";
  for (int i = 0; i < 5; ++i) program += pass + "G4 P0." + std::to_string(137 + 211 * i) + "\n";
  const Played result = run(program + "M5\nM2\n", lathe(rippling));
  // Each pass in turns; the groove is the same where that differs by whole ones.
  Spread all;
  std::vector<double> passes;
  for (const Cut& cut : result.cuts) {
    if (cut.z > -6 || cut.z < -6.01) continue;
    passes.push_back(groove(cut, 1.5) - std::floor(groove(cut, 1.5)));
    all.see(passes.back());
  }
  ASSERT_GE(passes.size(), 5U);
  std::printf("5 passes lie within %.4f mm of each other\n", all.mm(1.5));
  EXPECT_LT(all.mm(1.5), 0.01);
}

TEST(SpindleFollowing, all_passes_of_a_threading_cycle_lie_in_one_groove) {
  const std::string program = "G21 G18 S600 M3\nG0 X5 Z0\nG76 P1.5 Z-15 I-1 J0.2 K0.9 R1.5 H2\nM5\nM2\n";
  for (const bool jerk : {false, true}) {
    const Played result = run(program, lathe(rippling, jerk));
    double worst = 0;
    std::size_t passes = 0;
    for (const double z : {-5.0, -8.0, -11.0, -14.0}) {
      Spread all;
      const std::vector<double> grooves = grooves_at(result.cuts, 1.5, z);
      for (const double each : grooves) all.see(each);
      passes = grooves.size();
      EXPECT_GE(passes, 8U);
      worst = std::max(worst, all.mm(1.5));
    }
    std::printf("%s: %zu passes of a G76 lie within %.4f mm of each other\n", jerk ? "with jerk limit" : "without",
                passes, worst);
    EXPECT_LT(worst, jerk ? 0.03 : 0.012);
  }
}

TEST(SpindleFollowing, a_tap_is_in_the_groove_down_through_the_reversal_and_back) {
  SpindleDescription even = rippling;
  even.ripple = 0;
  for (const SpindleDescription& spindle : {even, rippling}) {
    const Played result = run("G21 S600 M3\nG0 Z2\nG33.1 Z-12 K1.5\nM5\nM2\n", lathe(spindle), true);
    double deepest = 0;
    std::size_t bottom = 0;
    for (std::size_t i = 0; i < result.cuts.size(); ++i) {
      if (result.cuts[i].z >= deepest) continue;
      deepest = result.cuts[i].z;
      bottom = i;
    }
    Spread down;
    Spread round;
    Spread back;
    for (std::size_t i = 0; i < result.cuts.size(); ++i) {
      const Cut& cut = result.cuts[i];
      if (cut.z > -3) continue;
      (cut.z < -12 ? round : i < bottom ? down : back).see(groove(cut, 1.5));
    }
    Spread all = down;
    for (const Spread& part : {round, back}) {
      all.see(part.low);
      all.see(part.high);
    }
    std::printf(
        "ripple %.0f %%: %.2f mm beyond the end; the groove wanders %.4f mm down, %.4f mm round, %.4f mm back, "
        "%.4f mm in all\n",
        100 * spindle.ripple, -12 - deepest, down.mm(1.5), round.mm(1.5), back.mm(1.5), all.mm(1.5));
    EXPECT_LT(all.mm(1.5), 0.08);
    EXPECT_GT(-12 - deepest, 1);
  }
}

TEST(SpindleFollowing, a_hole_is_tapped_twice_in_one_groove_and_either_way_round) {
  for (const char* turn : {"M3", "M4"}) {
    const std::string tap = "G33.1 Z-12 K1.5\nG4 P0.137\n";
    const Played result = run("G21 S600 " + std::string(turn) + "\nG0 Z2\n" + tap + tap + "M5\nM2\n", lathe(rippling));
    std::vector<Cut> cuts = result.cuts;
    for (Cut& cut : cuts) cut.turns = turn[1] == '3' ? cut.turns : -cut.turns;
    const std::vector<double> taps = grooves_at(cuts, 1.5, -8);
    ASSERT_EQ(taps.size(), 2U);
    EXPECT_NEAR(taps[0] * 1.5, taps[1] * 1.5, 0.02) << turn;
  }
}

TEST(SpindleFollowing, a_feed_a_revolution_is_as_fast_as_the_spindle_turns) {
  SpindleDescription slow{.counts_per_turn = 4096, .droop = 0.2};
  const std::string program = "G21 G95 S600 M3\nG1 Z-20 F0.5\nM2\n";
  EXPECT_NEAR(run(program, lathe(ideal)).time, 4, 0.1);
  EXPECT_NEAR(run(program, lathe(slow)).time, 5, 0.15);
}

TEST(SpindleFollowing, a_machine_without_an_encoder_takes_the_speed_as_commanded) {
  EXPECT_NEAR(run("G21 S600 M3\nG33 Z-15 K1.5\nM2\n", lathe({})).time, 1, 0.05);
}

// Nothing follows the spindle, so its override waits for the thread's end. By the spindle's true angle, with its
// run-up.
TEST(SpindleFollowing, a_thread_without_an_encoder_keeps_its_pitch_whatever_the_override) {
  const MachineDescription machine = lathe({.run_up = Seconds(0.5)});
  for (const bool over_a_line : {false, true}) {
    for (const double factor : {0.5, 1.5}) {
      Diagnostics diagnostics;
      IdealPlant plant = plant_of(machine);
      const std::string program = "G21 S600 M3\nG4 P1\nG1 X2 F600\nG33 Z-15 K1.5\nG1 X8 F600\nG4 P0.5\nX9\nM5\nM2\n";
      test::DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics,
                              {.line = over_a_line ? std::optional(LineOptions()) : std::nullopt, .plant = &plant});
      test::Thread thread(machine, plant);
      job.machine().add_observer(thread);
      job.drive().set_spindle_override(factor);
      bool was_overridden = false;
      bool is_overridden = false;
      do {
        const BoardOutputs outputs = job.machine().counts().outputs;
        const bool is = outputs.spindle_rpm == std::lround(600 * factor);
        (thread.cuts.empty() ? was_overridden : is_overridden) |= is;
      } while (job.advance());
      const double off = spread(thread.cuts, 1.5, -2, -14).mm(1.5);
      std::printf("override %g%s: the groove wanders %.4f mm\n", factor, over_a_line ? " over a line" : "", off);
      EXPECT_LT(off, 0.02);
      EXPECT_TRUE(was_overridden) << "before the thread";
      EXPECT_TRUE(is_overridden) << "behind the thread";
    }
  }
}

// Twice as fast as the program says, a thread of 37.5 mm/s needs 75 of Z, whose limit is 50.
void expect_outrun(const std::optional<LineOptions>& line, double override_at) {
  const MachineDescription machine = lathe(ideal);
  Diagnostics diagnostics;
  IdealPlant plant = plant_of(machine);
  test::DrivenProgram job(ProgramReader::from_text("t", "G21 S1500 M3\nG33 Z-60 K1.5\nG0 X10\nM5\nM2\n"), machine,
                          InterpreterOptions(), diagnostics, {.line = line, .plant = &plant});
  test::Thread thread(machine, plant);
  job.machine().add_observer(thread);
  const auto depth = [&] { return thread.cuts.empty() ? 0.0 : thread.cuts.back().z; };
  bool raised = false;
  do {
    if (!raised && depth() <= override_at) job.drive().set_spindle_override(2);
    raised = raised || depth() <= override_at;
  } while (job.advance());
  ASSERT_TRUE(job.link().error());
  EXPECT_EQ(*job.link().error(), LinkError::thread_outrun) << message_of(*job.link().error());
  EXPECT_EQ(job.machine().counts().outputs.switches, 0) << "the spindle is off";
  EXPECT_LT(std::abs(depth() - override_at), 8) << "braked in the thread";
}

TEST(SpindleFollowing, a_thread_that_an_axis_cannot_follow_any_more_ends_in_words) {
  for (const double override_at : {0.0, -20.0}) {
    expect_outrun({}, override_at);
    expect_outrun(LineOptions{.baud = 1'000'000, .latency = Seconds(0.001)}, override_at);
  }
}

TEST(SpindleFollowing, a_thread_at_an_axis_limit_is_cut) {
  const Played result = run("G21 S2000 M3\nG33 Z-60 K1.5\nM5\nM2\n", lathe(ideal));
  EXPECT_LT(spread(result.cuts, 1.5, -10, -55).mm(1.5), 0.03);
}

}  // namespace
}  // namespace passo
