// How much of a program is executed, where it is planned ahead, and planned anew after a hold.
#include "../progress_ahead.hpp"

#include <gtest/gtest.h>

#include "passo/path/segment.hpp"

namespace passo {
namespace {

TEST(ProgressAhead, follows_what_is_executed_not_what_is_planned) {
  ProgressAhead ahead;
  // With its ramps a motion takes longer than its nominal time.
  ahead.plan(Seconds(2), Seconds(10), Seconds(14), Seconds(10));
  ahead.plan(Seconds(1), Seconds(14), Seconds(15), Seconds(10));
  EXPECT_EQ(ahead.at(Seconds(10)), Seconds(0));
  EXPECT_EQ(ahead.at(Seconds(12)), Seconds(1));
  EXPECT_EQ(ahead.at(Seconds(14.5)), Seconds(2.5));
  EXPECT_EQ(ahead.at(Seconds(99)), Seconds(3));
}

TEST(ProgressAhead, counts_once_what_is_planned_anew) {
  ProgressAhead ahead;
  ahead.plan(Seconds(4), Seconds(0), Seconds(4), Seconds(0));
  ahead.plan(Seconds(4), Seconds(4), Seconds(8), Seconds(0));
  // A hold at 1 s: it brakes, rests, and goes on with the three quarters that are left.
  ahead.plan(Seconds(0.5), Seconds(1), Seconds(2), Seconds(0.5));
  EXPECT_EQ(ahead.at(Seconds(5)), Seconds(1.5));
  ahead.plan(Seconds(2.5), Seconds(6), Seconds(9), Seconds(5));
  ahead.plan(Seconds(4), Seconds(9), Seconds(13), Seconds(5));
  EXPECT_EQ(ahead.at(Seconds(7.5)), Seconds(2.75));
  EXPECT_EQ(ahead.at(Seconds(13)), Seconds(8));
}

MotionLimits fast() {
  MotionLimits limits;
  for (const Axis axis : all_axes) limits.velocity[axis] = MmPerSecond(1000);
  return limits;
}
PathItem line_of(double from, double to) {
  Point begin;
  Point end;
  begin[Axis::x] = from;
  end[Axis::x] = to;
  return Segment{.curve = Curve::line(begin, end), .speed = MmPerSecond(10)};
}

TEST(ProgressAhead, counts_no_lead_in) {
  ProgressAhead ahead;
  ahead.begin_with({line_of(0, 20)}, fast());
  ahead.plan(Seconds(2), Seconds(0), Seconds(2), Seconds(0));
  ahead.plan(Seconds(3), Seconds(2), Seconds(5), Seconds(0));
  EXPECT_EQ(ahead.at(Seconds(1)), Seconds(-1));
  EXPECT_EQ(ahead.at(Seconds(2)), Seconds(0));
  EXPECT_EQ(ahead.at(Seconds(5)), Seconds(3));
}

class Lines final : public Source<PathItem> {
 public:
  [[nodiscard]] bool next(PathItem& item) override {
    if (count_ == 3) return false;
    item = line_of(count_ * 10.0, count_ * 10.0 + 10);
    ++count_;
    return true;
  }

 private:
  int count_ = 0;
};

TEST(SkippedTime, counts_all_before_the_place_where_the_motion_begins) {
  Lines lines;
  SkippedTime path(lines, fast(), {.item = 1, .s = Mm(4)});
  PathItem item;
  int items = 0;
  while (path.next(item)) ++items;
  EXPECT_EQ(items, 3);
  EXPECT_NEAR(path.time().value(), 1.4, 1e-12);
}

}  // namespace
}  // namespace passo
