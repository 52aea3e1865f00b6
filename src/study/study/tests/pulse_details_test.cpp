// The tables of the sources, with their own numbers.
#include "passo/study/pulse_details.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/study/measure.hpp"

namespace passo {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

// One cell of each pulse: the name of a beat, or "feed".
std::vector<std::string> column(const std::string& wanted, const Method& method, const StepMove& move) {
  std::int64_t pulses = 0;
  EXPECT_TRUE(follow(method, move, [&](const Followed&) { ++pulses; }));
  const PulseDetails beats(method, move, pulses);
  auto source = start(method, move);
  std::vector<std::int64_t> decisions;
  (*source)->decisions(decisions);
  Place place = move.from;
  std::vector<std::string> found;
  const auto look = [&](const std::vector<std::string>& names, const std::vector<std::string>& cells) {
    EXPECT_EQ(names.size(), cells.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == wanted) found.push_back(cells[i]);
    }
  };
  for (std::int64_t k = 1; k <= pulses; ++k) {
    look(beats.judge_names(), beats.judge(k, place, decisions));
    const Pulse pulse = (*source)->next();
    look({"feed"}, {PulseDetails::feed(pulse)});
    apply(pulse, place);
    (*source)->decisions(decisions);
    look(beats.end_names(), beats.end(k, place));
  }
  return found;
}

StepMove from_zero(Place to) {
  return {.from = Place(to.size(), 0), .to = to, .arc = {}};
}

TEST(PulseDetails, of_master_and_slaves_are_fractions_and_the_midlines_of_the_cells) {
  const Method method{.name = MethodName::master_slave};
  EXPECT_THAT(column("ideal_y", method, from_zero({7, 3})),
              ElementsAre("3/7", "6/7", "1 2/7", "1 5/7", "2 1/7", "2 4/7", "3"));
  EXPECT_THAT(column("midline_y", method, from_zero({7, 3})),
              ElementsAre("1/2", "1/2", "1 1/2", "1 1/2", "2 1/2", "2 1/2", "3 1/2"));
  EXPECT_THAT(column("feed", method, from_zero({7, 3})), ElementsAre("+x", "+x+y", "+x", "+x+y", "+x", "+x+y", "+x"));
}

TEST(PulseDetails, of_lean_are_the_sums_before_a_step_is_taken_off) {
  EXPECT_THAT(column("sum_y", {.name = MethodName::lean}, from_zero({10, -4})),
              ElementsAre("-2", "6", "-6", "2", "-10", "-2", "6", "-6", "2", "-10"));
}

TEST(PulseDetails, of_slope_recalculated_are_the_slopes) {
  const Method method{.name = MethodName::slope_recalculated};
  auto slopes = column("slope_left", method, from_zero({27, 3}));
  slopes.resize(3);
  EXPECT_THAT(slopes, ElementsAre("0.111", "0.115", "0.080"));
  EXPECT_EQ(column("slope", method, from_zero({-3, 27})).front(), "0.111");
}

TEST(PulseDetails, of_slope_in_blocks_are_its_runs) {
  const Method method{.name = MethodName::slope_blocks};
  std::vector<std::string> runs;
  std::vector<std::string> feeds;
  for (int block = 0; block < 3; ++block) {
    for (const char* run : {"1 of 4", "2 of 4", "3 of 4", "4 of 4", "1 of 1", "1 of 4", "2 of 4", "3 of 4", "4 of 4"}) {
      runs.emplace_back(run);
      feeds.emplace_back(run == std::string("1 of 1") ? "+x+y" : "+x");
    }
  }
  EXPECT_THAT(column("run", method, from_zero({27, 3})), ElementsAreArray(runs));
  EXPECT_THAT(column("feed", method, from_zero({27, 3})), ElementsAreArray(feeds));
  const auto blocks = column("block", method, from_zero({27, 10}));
  EXPECT_EQ(blocks[20], "7");  // seven blocks of three pulses, three of two
  EXPECT_EQ(blocks[21], "8");
  EXPECT_EQ(blocks.back(), "10");
  EXPECT_THAT(column("run", method, from_zero({2, 0})), ElementsAre("1 of 2", "2 of 2"));
}

TEST(PulseDetails, of_slope_in_blocks_tell_a_diagonal_from_a_plain_step_on_every_line) {
  for (std::int64_t dx = 1; dx < 30; ++dx) {
    for (std::int64_t dy = 1; dy <= dx; ++dy) {
      const Method method{.name = MethodName::slope_blocks};
      const auto feeds = column("feed", method, from_zero({dx, dy}));
      const auto blocks = column("block", method, from_zero({dx, dy}));
      std::int64_t diagonals = 0;
      for (std::size_t k = 0; k < feeds.size(); ++k) {
        if (feeds[k] != "+x+y") continue;
        EXPECT_EQ(blocks[k], std::to_string(++diagonals)) << dx << "," << dy;
      }
    }
  }
}

TEST(PulseDetails, of_point_comparison_are_four) {
  const Method total{.name = MethodName::point_comparison};
  EXPECT_THAT(column("judge", total, from_zero({4, 2})), ElementsAre("F>=0", "F<0", "F>=0", "F>=0", "F<0", "F>=0"));
  EXPECT_THAT(column("left", total, from_zero({4, 2})), ElementsAre("5", "4", "3", "2", "1", "0"));
  const Method coordinates{.name = MethodName::point_comparison, .end_judging = EndJudging::coordinates};
  EXPECT_THAT(column("left_x", coordinates, from_zero({4, 2})), ElementsAre("3", "3", "2", "1", "1", "0"));
  EXPECT_THAT(column("left_y", coordinates, from_zero({4, 2})), ElementsAre("2", "1", "1", "1", "0", "0"));
  const Method projection{.name = MethodName::point_comparison, .end_judging = EndJudging::projection};
  EXPECT_THAT(column("left_x", projection, from_zero({4, 2})), ElementsAre("3", "3", "2", "1", "1", "0"));
  EXPECT_THAT(column("left_y", projection, from_zero({2, 4})).back(), "0");
}

TEST(PulseDetails, of_integrators_are_the_sums_that_overflow) {
  EXPECT_THAT(column("sum_y", {.name = MethodName::dda}, from_zero({5, 3})),
              ElementsAre("3", "6", "9", "4", "7", "10", "5", "8"));
  // On an arc each integrator adds the other axis's distance. It feeds where the sum reaches 2^N = 8.
  const StepMove arc{.from = {5, 0}, .to = {0, 5}, .arc = StepMove::Arc{.centre = {0, 0}, .clockwise = false}};
  const auto sums = column("sum_y", {.name = MethodName::dda}, arc);
  const auto feeds = column("feed", {.name = MethodName::dda}, arc);
  EXPECT_EQ(sums[0], "5");
  EXPECT_EQ(sums[1], "10");
  EXPECT_EQ(feeds[0], "none");
  EXPECT_EQ(feeds[1], "+y");
}

TEST(PulseDetails, of_the_midpoint_are_its_recursion_the_same_in_every_quadrant_and_sense) {
  const Method method{.name = MethodName::midpoint};
  const auto quarter = [&](const Place& from, const Place& to, bool clockwise) {
    return column("at_midpoint", method,
                  {.from = from, .to = to, .arc = StepMove::Arc{.centre = {0, 0}, .clockwise = clockwise}});
  };
  const auto first = quarter({10, 0}, {0, 10}, false);
  EXPECT_THAT(first, ElementsAre("-9", "-6", "-1", "6", "-3", "8", "5", "-8", "-3", "6", "-1", "14", "11", "10"));
  EXPECT_EQ(quarter({0, 10}, {-10, 0}, false), first);
  EXPECT_EQ(quarter({-10, 0}, {0, -10}, false), first);
  EXPECT_EQ(quarter({0, -10}, {10, 0}, false), first);
  EXPECT_EQ(quarter({10, 0}, {0, -10}, true), first);
  EXPECT_EQ(quarter({0, -10}, {-10, 0}, true), first);
  EXPECT_EQ(quarter({-10, 0}, {0, 10}, true), first);
  EXPECT_EQ(quarter({0, 10}, {10, 0}, true), first);
}

}  // namespace
}  // namespace passo
