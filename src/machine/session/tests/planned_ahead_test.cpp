#include "../planned_ahead.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

Action dwell(double seconds) {
  return {.kind = Action::Kind::dwell, .dwell = Seconds(seconds)};
}

TEST(PlannedAhead, tells_the_line_whose_motion_is_made) {
  LinesAhead lines;
  Point zero;
  zero[Axis::z] = 2;
  lines.plan({.source = {.line = 3}}, Seconds(1), Seconds(0));
  lines.plan({.source = {.line = 3}}, Seconds(2), Seconds(0));
  lines.plan({.source = {.line = 4}}, Seconds(3), Seconds(0));
  lines.plan({.source = {.line = 4}, .work_zero = zero}, Seconds(4), Seconds(0));
  EXPECT_EQ(lines.at(Seconds(0.5)).source.line, 0U);
  EXPECT_EQ(lines.at(Seconds(2.5)).source.line, 3U);
  EXPECT_EQ(lines.at(Seconds(3)).source.line, 4U);
  EXPECT_EQ(lines.at(Seconds(3.5)).work_zero, Point());
  EXPECT_EQ(lines.at(Seconds(4)).work_zero, zero) << "the same line, run again with another offset";
}

TEST(PlannedAhead, tells_the_progress_of_a_program_that_has_a_nominal_time) {
  PlannedAhead ahead;
  ahead.begin(Point(), {}, MotionLimits(), Seconds(10));
  ahead.plan(dwell(4), Seconds(0), Seconds(4), Seconds(0));
  EXPECT_EQ(ahead.progress_at(Seconds(2), Seconds(0)), 0.2);
  EXPECT_EQ(ahead.progress_at(Seconds(3), Seconds(2)), 0.5);  // it began amid its path
  EXPECT_EQ(ahead.progress_at(Seconds(99), Seconds(9)), 1.0);
}

TEST(PlannedAhead, makes_no_progress_in_a_lead_in) {
  PlannedAhead ahead;
  ahead.begin(Point(), {PathItem(dwell(3))}, MotionLimits(), Seconds(10));
  ahead.plan(dwell(3), Seconds(0), Seconds(3), Seconds(0));
  ahead.plan(dwell(5), Seconds(3), Seconds(8), Seconds(0));
  EXPECT_EQ(ahead.progress_at(Seconds(2), Seconds(0)), 0.0);
  EXPECT_EQ(ahead.progress_at(Seconds(4), Seconds(0)), 0.1);
}

TEST(PlannedAhead, tells_no_progress_without_a_nominal_time) {
  PlannedAhead ahead;
  ahead.begin(Point(), {}, MotionLimits(), Seconds(0));
  ahead.plan(dwell(4), Seconds(0), Seconds(4), Seconds(0));
  EXPECT_FALSE(ahead.progress_at(Seconds(2), Seconds(0)));
}

TEST(PlannedAhead, ends_the_program_once_when_the_motion_before_its_end_is_made) {
  PlannedAhead ahead;
  EXPECT_FALSE(ahead.take_program_end(Seconds(99)));
  ahead.plan({.kind = Action::Kind::program_end}, Seconds(5), Seconds(5), Seconds(0));
  EXPECT_FALSE(ahead.take_program_end(Seconds(4.9)));
  EXPECT_TRUE(ahead.take_program_end(Seconds(5)));
  EXPECT_FALSE(ahead.take_program_end(Seconds(5)));
  ahead.plan({.kind = Action::Kind::program_end}, Seconds(9), Seconds(9), Seconds(5));
  EXPECT_TRUE(ahead.take_program_end());  // the work has ended before
  EXPECT_FALSE(ahead.take_program_end());
}

}  // namespace
}  // namespace passo
