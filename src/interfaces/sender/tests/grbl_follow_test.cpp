// A machine that is followed: how much motion lies in it, and what is noticed of faults on its line. The machine plans
// its motion, and its line carries 115,200 baud.
#include <cmath>
#include <filesystem>
#include <vector>

#include "followed_pair.hpp"
#include "grbl_program_lines.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

std::vector<std::string> long_moves() {
  return {"G1F3000X100Y0Z0", "X100Y80", "G2X180Y80Z0I40J0", "G0X0Y0", "G1F60X2", "G4P0"};
}

TEST(GrblFollow, a_followed_machine_ends_where_the_lines_lead) {
  FollowedPair pair;
  ASSERT_TRUE(pair.begin());
  ASSERT_TRUE(pair.run(long_moves()));
  EXPECT_FALSE(pair.sender.fault()) << pair.sender.fault()->message;
  EXPECT_NEAR(pair.machine.place()[Axis::x], 2, 1e-9);
  EXPECT_NEAR(pair.machine.place()[Axis::y], 0, 1e-9);
  EXPECT_FALSE(pair.machine.overflowed());
}

TEST(GrblFollow, at_most_a_second_of_motion_lies_in_the_machine) {
  for (const double ahead : {0.5, 1.0}) {
    double most = 0;
    for (int cut = 3; cut < 60; cut += 4) {
      FollowedPair pair;
      ASSERT_TRUE(pair.begin(Seconds(ahead)));
      static_cast<void>(pair.run(long_moves(), {}, Seconds(0.207 * cut)));
      ASSERT_FALSE(pair.sender.fault()) << pair.sender.fault()->message;
      most = std::max(most, pair.runs_on());
    }
    // It must be able to reach and to leave the speed of rapids: 0.4 s.
    EXPECT_LE(most, std::max(ahead + 0.05, 0.75)) << "including what was on the line";
    EXPECT_GT(most, ahead * 0.6);
  }
}

GrblLimits fast_router() {
  GrblLimits limits;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    limits.steps_per_mm[axis] = 250;
    limits.velocity[axis] = MmPerSecond(100);
    limits.acceleration[axis] = MmPerSecond2(500);
  }
  return limits;
}

TEST(GrblFollow, lines_follow_a_dwell_of_any_length) {
  FollowedPair pair;
  ASSERT_TRUE(pair.begin());
  const std::vector<std::string> lines{"G4P1.2", "G1F600X10Y0Z0", "G4P0.5", "G4P1.2", "X20", "G4P0"};
  ASSERT_TRUE(pair.run(lines, {}, Seconds(30)));
  EXPECT_FALSE(pair.sender.fault()) << pair.sender.fault()->message;
  EXPECT_NEAR((pair.now - pair.begun).value(), 2.9 + 2, 0.5);
  EXPECT_NEAR(pair.machine.place()[Axis::x], 20, 1e-9);
}

TEST(GrblFollow, an_override_counts_after_a_further_beginning) {
  FollowedPair pair;
  ASSERT_TRUE(pair.begin());
  pair.sender.override_feed(50);
  ASSERT_TRUE(pair.run({"G1F600X1Y0Z0", "G4P0"}));
  pair.sender.follow({});
  double most = 0;
  static_cast<void>(pair.run(
      {"G1F600X60Y0Z0"}, [&] { most = std::max(most, pair.sender.time_in_machine().value()); }, Seconds(0.3)));
  EXPECT_LE(pair.runs_on(), 1.3) << "at half of the feed, and with a piece of 0.5 s to brake in";
  EXPECT_GT(most, 0.5);
}

TEST(GrblFollow, pieces_of_a_line_end_exactly_where_it_ends) {
  GrblFollower follower(fast_router(), {}, {}, Seconds(1));
  EXPECT_THAT(follower.pieces("G1F600X1Y0Z0"), testing::ElementsAre("G1F600X1Y0Z0")) << "0.1 s";
  EXPECT_THAT(follower.pieces("X6"), testing::ElementsAre("X3.5", "X6")) << "0.5 s";
  // Half a circle of 2.5 mm at 10 mm/s: 0.785 s. Each piece has the centre from its own start.
  const std::vector<std::string> arc = follower.pieces("G2X11Y0Z0I2.5J0");
  ASSERT_EQ(arc.size(), 4U);
  GrblLineReader reader({}, {});
  reader.read("G1F600X6Y0Z0");
  for (const std::string& piece : arc) {
    const GrblLineMotion motion = reader.read(piece);
    ASSERT_TRUE(motion.arc) << piece;
    EXPECT_NEAR(std::hypot(motion.arc->first_center, motion.arc->second_center), 2.5, 2e-4) << piece;
  }
  EXPECT_EQ(reader.place()[Axis::x], 11);
  EXPECT_EQ(reader.place()[Axis::y], 0);
}

TEST(GrblFollow, modes_are_compared_with_those_that_were_sent) {
  GrblFollower follower(fast_router(), {}, {}, Seconds(1));
  follower.sent("M3S1000", 1, Seconds(0));
  follower.sent("G1F600X1Y0Z0", 2, Seconds(0));
  const auto differs = [&](const char* modes) {
    const auto trouble = follower.check_modes(modes, follower.modes(), false);
    return trouble ? trouble->message : "";
  };
  EXPECT_EQ(differs("G1 G54 G17 G21 G90 G94 M3 M9 T0 F600 S1000"), "");
  EXPECT_THAT(differs("G0 G54 G17 G21 G90 G94 M3 M9 T0 F600 S1000"), testing::HasSubstr("it is in G0 instead of G1"));
  EXPECT_THAT(differs("G1 G54 G17 G21 G90 G94 M3 M9 T0 F60 S1000"), testing::HasSubstr("F60 instead of F600"));
  EXPECT_THAT(differs("G1 G54 G17 G21 G90 G94 M5 M9 T0 F600 S1000"), testing::HasSubstr("M5 instead of M3"));
  EXPECT_THAT(differs("G1 G54 G17 G21 G90 G94 M3 M9 T0 F600 S100"), testing::HasSubstr("S100 instead of S1000"));
}

// The programs of ../shared/peers/motion-mm, which need nothing that GrblCode would write otherwise.
TEST(GrblFollow, costs_no_time) {
  const std::string folder = PASSO_SOURCE_DIR "/../shared/peers/motion-mm";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no ../shared/peers/motion-mm beside the checkout";
  const bool all = test::in_full() > 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".nc") continue;
    const std::string name = file.path().filename();
    if (!all && name.find("p03") == std::string::npos && name.find("p10") == std::string::npos) continue;
    MachineDescription router = test::example_machine("router");
    for (AxisDescription& axis : router.axes) {
      axis.travel_low = -10000;
      axis.travel_high = 10000;
      axis.velocity = MmPerSecond(axis.axis == Axis::z ? 50 : 100);
    }
    Diagnostics findings;
    auto program = ProgramReader::open(file.path());
    ASSERT_TRUE(program) << name;
    test::GrblProgramLines lines(*program, router, {}, {}, false);
    std::vector<std::string> texts;
    while (const auto line = lines.next()) texts.push_back(line->text);
    double times[2] = {0, 0};
    std::uint64_t sent[2] = {0, 0};
    for (const bool follows : {false, true}) {
      FollowedPair pair;
      pair.machine.put(112, 3000);
      for (const int axis : {0, 1, 2}) pair.machine.put(100 + axis, 400);
      ASSERT_TRUE(pair.greet());
      if (follows) pair.sender.follow({});
      const Seconds begun = pair.now;
      ASSERT_TRUE(pair.run(texts)) << name;
      EXPECT_FALSE(pair.sender.fault()) << name << ": " << pair.sender.fault()->message;
      times[follows ? 1 : 0] = (pair.now - begun).value();
      sent[follows ? 1 : 0] = pair.sender.lines_sent();
    }
    fmt::print("{:20} {:6} lines {:9.2f} s, followed {:9.2f} s, {:.4f}\n", name, sent[0], times[0], times[1],
               times[1] / times[0]);
    EXPECT_LT(times[1], times[0] * 1.01 + 0.2) << name;
  }
}

// Lines of 0.3 mm at F3000: 167 a second, of about 18 bytes each.
TEST(GrblFollow, short_lines_do_not_starve_the_machine) {
  const int count = test::in_full() > 0 ? 1'000'000 : 5000;
  FollowedPair pair;
  ASSERT_TRUE(pair.begin());
  int next = 0;
  double slowest = 1e9;
  std::size_t fewest = 100;
  double sum = 0;
  int looks = 0;
  const auto feed = [&] {
    while (pair.sender.wants_lines() && next < count && !pair.sender.fault()) {
      ++next;
      const double angle = 0.01 * next;
      pair.sender.add(
          fmt::format("{}X{:.4f}Y{:.4f}", next == 1 ? "G1F3000" : "", 30 * std::cos(angle) - 30, 30 * std::sin(angle)),
          static_cast<std::uint32_t>(next));
      if (next == count) pair.sender.add("G4P0", static_cast<std::uint32_t>(next));
    }
    if (next > 200 && next < count) {
      slowest = std::min(slowest, pair.machine.speed());
      fewest = std::min(fewest, pair.machine.blocks_held());
      sum += static_cast<double>(pair.machine.blocks_held());
      ++looks;
    }
  };
  const Seconds begun = pair.now;
  ASSERT_TRUE(pair.play_for(
      Seconds(10000), [&] { return (next == count && pair.sender.at_rest()) || pair.sender.stopped(); }, feed));
  EXPECT_FALSE(pair.sender.fault()) << pair.sender.fault()->message;
  const double time = (pair.now - begun).value();
  fmt::print(
      "{} lines in {:.1f} s (at F3000 {:.1f} s): slowest {:.2f} mm/s, blocks held {} at least, {:.1f} on average\n",
      count, time, count * 0.3 / 50, slowest, fewest, sum / looks);
  EXPECT_GT(slowest, 49.9);
  EXPECT_LT(time, count * 0.3 / 50 + 1);
}

}  // namespace
}  // namespace passo
