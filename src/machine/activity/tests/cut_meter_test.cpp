#include "passo/activity/cut_meter.hpp"

#include <limits>

#include <gmock/gmock.h>

#include "passo/activity/cut_forecast.hpp"

namespace passo {
namespace {

Segment feed_to(const Point& from, const Point& to, std::uint32_t line = 1) {
  Segment segment{.curve = Curve::line(from, to), .speed = MmPerSecond(10)};
  segment.source.line = line;
  return segment;
}

Point at(double x) {
  Point point;
  point[Axis::x] = x;
  return point;
}

Action action(Action::Kind kind, SpindleDirection spindle, std::int32_t tool = 0) {
  Action one{.kind = kind, .tool = tool};
  one.outputs.spindle = spindle;
  return one;
}

// The part of a segment from one place on it to another, at constant speed.
PlannedMove part(const Segment& segment, double from, double to, double seconds) {
  PlannedMove move;
  move.begin_on(segment);
  move.add({.duration = Seconds(seconds), .start = Mm(from)});
  move.to = Mm(to);
  return move;
}

constexpr auto on = SpindleDirection::clockwise;
constexpr auto off = SpindleDirection::off;

TEST(CutMeter, counts_feeds_of_a_tool_while_the_spindle_turns) {
  CutMeter meter;
  const Segment feed = feed_to(at(0), at(100));
  meter.watch(part(feed, 0, 100, 9));  // no tool, no spindle
  meter.watch(action(Action::Kind::tool_change, off, 3));
  meter.watch(part(feed, 0, 100, 9));  // no spindle
  meter.watch(action(Action::Kind::outputs, on));
  meter.watch(part(feed, 0, 40, 5));
  meter.watch(part(feed, 40, 100, 6));
  Segment rapid = feed;
  rapid.rapid = true;
  meter.watch(part(rapid, 0, 100, 1));
  Segment backlash = feed;
  backlash.takes_up_backlash = true;
  meter.watch(part(backlash, 0, 100, 1));
  EXPECT_EQ(meter.amounts(), (CutAmounts{{3, {Mm(100), Seconds(11)}}}));
  meter.watch(action(Action::Kind::tool_change, off, 4));
  meter.watch(action(Action::Kind::outputs, on));
  meter.watch(part(feed, 0, 10, 2));
  EXPECT_EQ(meter.amounts().at(4), (CutAmount{Mm(10), Seconds(2)}));
}

TEST(CutMeter, leaves_probe_moves_holds_and_the_lead_in_out) {
  OutputState turning;
  turning.spindle = on;
  CutMeter meter(7, turning, 2);
  const Segment feed = feed_to(at(0), at(10));
  meter.watch(action(Action::Kind::outputs, off));  // the first item of the lead-in
  meter.watch(part(feed, 0, 4, 1));                 // the second one, in two moves
  meter.watch(part(feed, 4, 10, 1));
  EXPECT_TRUE(meter.amounts().empty());
  meter.watch(action(Action::Kind::feed_hold, off));
  meter.watch(part(feed, 0, 10, 1));
  EXPECT_EQ(meter.amounts().at(7).length, Mm(10)) << "a hold does not stop the spindle";
  meter.watch(action(Action::Kind::probe_begin, on));
  meter.watch(part(feed, 0, 10, 1));
  meter.watch(action(Action::Kind::probe_end, on));
  EXPECT_EQ(meter.amounts().at(7).length, Mm(10));
  // A tool changed by hand, at M0.
  meter.watch(action(Action::Kind::program_stop, on, 8));
  meter.watch(part(feed, 0, 10, 1));
  EXPECT_EQ(meter.amounts().at(8).length, Mm(10));
}

TEST(CutMeter, counts_the_time_of_a_rotary_move_but_no_length) {
  OutputState turning;
  turning.spindle = on;
  CutMeter meter(1, turning, 0);
  Point turned;
  turned[Axis::a] = 90;
  meter.watch(PathItem(feed_to(Point(), turned)), Seconds(3));
  EXPECT_EQ(meter.amounts().at(1), (CutAmount{Mm(0), Seconds(3)}));
  meter.watch(PathItem(feed_to(at(0), at(8))), Seconds(4), 0.25);
  EXPECT_EQ(meter.amounts().at(1), (CutAmount{Mm(2), Seconds(4)}));
}

MotionLimits fast() {
  MotionLimits limits;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) limits.velocity[axis] = MmPerSecond(1000);
  return limits;
}

CutForecast forecast_of(LivesLeft left) {
  CutForecast forecast(fast(), std::move(left));
  forecast.add(action(Action::Kind::tool_change, off, 3));
  forecast.add(action(Action::Kind::outputs, on));
  for (std::uint32_t line = 3; line <= 12; ++line) forecast.add(feed_to(at(0), at(1000), line));
  return forecast;
}

std::string findings_of(const CutForecast& forecast) {
  Diagnostics findings;
  forecast.add_findings("part.ngc", findings);
  EXPECT_FALSE(findings.any_error());
  return render(findings, false);
}

TEST(CutForecast, warns_at_the_line_where_a_life_ends) {
  EXPECT_EQ(findings_of(forecast_of({})), "");
  EXPECT_EQ(findings_of(forecast_of({{3, {.length = Mm(10'000)}}})), "");
  const std::string by_length = findings_of(forecast_of({{3, {.length = Mm(4500)}}}));
  EXPECT_THAT(by_length, testing::HasSubstr("part.ngc:7: warning: the life of T3 ends here: the program cuts 10.0 m "
                                            "with it, and 4.5 m are left [tool.life-ends]"));
  // 100 s for each line.
  const std::string by_time = findings_of(forecast_of({{3, {.length = Mm(9500), .time = Seconds(600)}}}));
  EXPECT_THAT(by_time, testing::HasSubstr("part.ngc:9: warning"));
  EXPECT_THAT(
      findings_of(forecast_of({{3, {.length = Mm(-2000)}}})),
      testing::HasSubstr("part.ngc:3: warning: the life of T3 ends here: the program cuts 10.0 m with it, and 0.0 m "
                         "are left"));
  EXPECT_EQ(findings_of(forecast_of({{4, {.length = Mm(1)}}})), "");
}

}  // namespace
}  // namespace passo
