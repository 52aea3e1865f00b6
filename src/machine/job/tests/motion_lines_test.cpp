#include "passo/job/motion_lines.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

Point at(double x, double y) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  return point;
}

// At an even speed.
PlannedMove move(std::uint32_t line, const Point& from, const Point& to, Seconds time = Seconds(1)) {
  Segment segment;
  segment.curve = Curve::line(from, to);
  segment.source.line = line;
  PlannedMove move;
  move.begin_on(segment);
  move.phase_count = 1;
  move.phases[0].duration = time;
  move.to = segment.curve.length();
  return move;
}

TEST(LatestMotions, know_the_line_that_comes_nearest_to_a_place) {
  LatestMotion latest;
  EXPECT_EQ(latest.line_at(at(0, 0)), 0U) << "nothing has moved";
  latest.watch(move(3, at(0, 0), at(10, 0)));
  latest.watch(move(4, at(10, 0), at(10, 10)));
  latest.watch(Action{.kind = Action::Kind::outputs});
  EXPECT_EQ(latest.line_at(at(4, 0.1)), 3U);
  EXPECT_EQ(latest.line_at(at(10, 4)), 4U);
  EXPECT_EQ(latest.line_at(at(10, 0)), 3U) << "of several the first";
  EXPECT_EQ(latest.line_at(at(99, 99)), 4U);
}

TEST(LatestMotions, forget_what_the_board_has_long_played) {
  LatestMotion latest;
  latest.watch(move(1, at(0, 0), at(100, 0)));
  for (std::uint32_t line = 2; line < 5000; ++line) latest.watch(move(line, at(0, line), at(0.5, line)));
  EXPECT_NE(latest.line_at(at(50, 0)), 1U);
  EXPECT_EQ(latest.line_at(at(0, 4990)), 4990U);
}

TEST(PlannedLines, know_the_line_that_is_played_at_a_time) {
  PlannedLines lines(Seconds(100));
  EXPECT_EQ(lines.line_at(Seconds(100)), 0U) << "nothing is planned";
  lines.watch(move(3, at(0, 0), at(10, 0)));
  lines.watch(move(3, at(10, 0), at(20, 0)));
  Action dwell;
  dwell.kind = Action::Kind::dwell;
  dwell.dwell = Seconds(5);
  dwell.source.line = 4;
  lines.watch(dwell);
  lines.watch(Action{.kind = Action::Kind::outputs});
  lines.watch(move(5, at(20, 0), at(30, 0)));
  for (const double time : {100.5, 101.5, 102.0}) EXPECT_EQ(lines.line_at(Seconds(time)), 3U) << time;
  EXPECT_EQ(lines.line_at(Seconds(104)), 4U);
  EXPECT_EQ(lines.line_at(Seconds(107.5)), 5U);
  lines.forget_before(Seconds(107.5));
  EXPECT_EQ(lines.line_at(Seconds(107.6)), 5U);
  lines.forget_before(Seconds(200));
  EXPECT_EQ(lines.line_at(Seconds(200)), 5U) << "the last line stays";
}

}  // namespace
}  // namespace passo
