#include "passo/verdict/speed_survey.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace passo {
namespace {

using Kind = SpeedBound::Kind;

MotionLimits usual_limits() {
  MotionLimits limits;
  limits.velocity[Axis::x] = limits.velocity[Axis::y] = MmPerSecond(100);
  limits.acceleration[Axis::x] = MmPerSecond2(1000);
  limits.acceleration[Axis::y] = MmPerSecond2(500);
  limits.jerk[Axis::y] = MmPerSecond3(20'000);
  return limits;
}

AxisSet two_axes() {
  AxisSet axes;
  axes.add(Axis::x);
  axes.add(Axis::y);
  return axes;
}

Point spot_of(double x, double y) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  return point;
}

PlannedMove motion_along(const Curve& curve, std::uint32_t line, double feed, std::initializer_list<Phase> phases) {
  PlannedMove move;
  Segment segment;
  segment.curve = curve;
  segment.source.line = line;
  segment.speed = MmPerSecond(feed);
  segment.rapid = feed == std::numeric_limits<double>::infinity();
  move.begin_on(segment);
  Mm start{0};
  for (Phase phase : phases) {
    phase.start = start;
    start = phase.position_at(phase.duration);
    move.add(phase);
  }
  move.to = start;
  return move;
}

constexpr double no_feed = std::numeric_limits<double>::infinity();

SpeedReport report_of(std::initializer_list<PlannedMove> moves) {
  SpeedSurvey survey(usual_limits(), two_axes());
  for (const PlannedMove& move : moves) survey.watch(move);
  return survey.report();
}

TEST(SpeedSurvey, names_feed_acceleration_and_velocity_with_their_times) {
  const Curve x = Curve::line({}, spot_of(1000, 0));
  const SpeedReport report =
      report_of({motion_along(x, 3, 50,
                              {{.duration = Seconds(0.05), .acceleration = MmPerSecond2(1000)},
                               {.duration = Seconds(2), .velocity = MmPerSecond(50)}}),
                 motion_along(x, 4, no_feed, {{.duration = Seconds(1), .velocity = MmPerSecond(100)}})});
  ASSERT_EQ(report.shares.size(), 3U);
  EXPECT_EQ(report.shares[0].bound.kind, Kind::feed);
  EXPECT_DOUBLE_EQ(report.shares[0].time.value(), 2);
  EXPECT_EQ(report.shares[1].bound, (SpeedBound{.kind = Kind::velocity, .axis = Axis::x}));
  EXPECT_EQ(report.shares[1].first_line, 4U);
  EXPECT_DOUBLE_EQ(report.shares[1].limit, 100);
  EXPECT_EQ(report.shares[2].bound, (SpeedBound{.kind = Kind::acceleration, .axis = Axis::x}));
  EXPECT_DOUBLE_EQ(report.shares[2].time.value(), 0.05);
  EXPECT_EQ(report.fastest[0].bound.kind, Kind::feed) << "not that of the ramp, which ends at the same speed";
}

TEST(SpeedSurvey, names_the_weaker_axis_of_a_slanting_line) {
  const Curve slant = Curve::line({}, spot_of(300, 400));
  // 500 mm/s² of Y are 625 along the line; X then has 375 of 1000.
  const SpeedReport report =
      report_of({motion_along(slant, 1, 100, {{.duration = Seconds(0.1), .acceleration = MmPerSecond2(625)}})});
  ASSERT_EQ(report.shares.size(), 1U);
  EXPECT_EQ(report.shares[0].bound, (SpeedBound{.kind = Kind::acceleration, .axis = Axis::y}));
}

TEST(SpeedSurvey, tells_a_bend_from_a_ramp) {
  Curve::ArcData circle;
  circle.start_radius = circle.end_radius = 5;
  circle.sweep = 6.283185307179586;
  const Curve arc = Curve::arc(spot_of(5, 0), spot_of(5, 0), circle);
  // v²/r = 500 mm/s²: Y has all of that at the start of the circle's upper half.
  const SpeedReport report =
      report_of({motion_along(arc, 1, 80, {{.duration = Seconds(0.6283), .velocity = MmPerSecond(50)}})});
  ASSERT_FALSE(report.shares.empty());
  EXPECT_TRUE(report.shares[0].bound.kind == Kind::bending || report.shares[0].bound.kind == Kind::passage);
  ASSERT_EQ(report.slowest.size(), 1U);
  EXPECT_NEAR(report.slowest[0].lost.value(), 0.6283 * (1 - 50.0 / 80), 1e-9);
}

TEST(SpeedSurvey, names_jerk_and_torque) {
  const Curve y = Curve::line({}, spot_of(0, 1000));
  MotionLimits limits = usual_limits();
  const AccelerationCurve::Sample samples[] = {{MmPerSecond(0), MmPerSecond2(1000)},
                                               {MmPerSecond(100), MmPerSecond2(100)}};
  limits.falling[Axis::x] = AccelerationCurve::below(samples, MmPerSecond2(1000));
  SpeedSurvey survey(limits, two_axes());
  survey.watch(motion_along(y, 1, 90, {{.duration = Seconds(0.02), .jerk = MmPerSecond3(20'000)}}));
  const MmPerSecond2 left = limits.falling[Axis::x].at(MmPerSecond(60));
  survey.watch(motion_along(Curve::line({}, spot_of(1000, 0)), 2, 90,
                            {{.duration = Seconds(1e-6), .velocity = MmPerSecond(60), .acceleration = left}}));
  const SpeedReport report = survey.report();
  ASSERT_EQ(report.shares.size(), 2U);
  EXPECT_EQ(report.shares[0].bound, (SpeedBound{.kind = Kind::jerk, .axis = Axis::y}));
  EXPECT_EQ(report.shares[1].bound, (SpeedBound{.kind = Kind::torque, .axis = Axis::x}));
  EXPECT_EQ(describe(report.shares[1].bound), "the torque of X's motor");
}

TEST(SpeedSurvey, keeps_the_lines_that_lose_most_and_those_that_are_fastest) {
  SpeedSurvey survey(usual_limits(), two_axes());
  const Curve x = Curve::line({}, spot_of(1000, 0));
  for (std::uint32_t line = 1; line <= 50; ++line) {
    survey.watch(motion_along(x, line, 95, {{.duration = Seconds(1), .velocity = MmPerSecond(line)}}));
  }
  survey.watch(motion_along(x, 51, no_feed, {{.duration = Seconds(1), .velocity = MmPerSecond(100)}}));
  const SpeedReport report = survey.report();
  ASSERT_EQ(report.slowest.size(), SpeedSurvey::most_parts);
  ASSERT_EQ(report.fastest.size(), SpeedSurvey::most_parts + 1);
  EXPECT_EQ(report.slowest[0].line, 1U);
  EXPECT_EQ(report.slowest[4].line, 5U);
  EXPECT_EQ(report.fastest[0].line, 50U);
  EXPECT_TRUE(report.fastest.back().rapid);
  EXPECT_EQ(report.fastest.back().bound.kind, Kind::velocity);
  EXPECT_DOUBLE_EQ(report.slowest[0].mean().value(), 1);
}

// Where a line turns back, the tool rests until the backlash is taken up. The line stays one part, and the rest is
// lost.
TEST(SpeedSurvey, counts_the_backlash_of_a_line_as_time_that_the_line_loses) {
  const auto cut = [](double from, double to, std::uint32_t line) {
    return motion_along(Curve::line(spot_of(from, 0), spot_of(to, 0)), line, 10,
                        {Phase{.duration = Seconds(0.1), .velocity = MmPerSecond(10)}});
  };
  const auto take_up = [](double at, std::uint32_t line) {
    PlannedMove move = motion_along(Curve::line(spot_of(at - 1, 0), spot_of(at, 0)), line, no_feed,
                                    {Phase{.duration = Seconds(0.05), .velocity = MmPerSecond(20)}});
    move.segment.takes_up_backlash = true;
    return move;
  };
  const SpeedReport report = report_of({take_up(0, 7), cut(0, 1, 7), take_up(1, 7), cut(1, 0, 7), cut(0, 1, 8)});
  ASSERT_FALSE(report.slowest.empty());
  EXPECT_EQ(report.slowest[0].line, 7U);
  EXPECT_FALSE(report.slowest[0].rapid);
  EXPECT_NEAR(report.slowest[0].lost.value(), 0.1, 1e-12);
  EXPECT_NEAR(report.slowest[0].time.value(), 0.3, 1e-12);
  EXPECT_NEAR(report.slowest[0].way.value(), 2, 1e-12);
  EXPECT_EQ(report.slowest[0].highest, MmPerSecond(10));
}

TEST(SpeedSurvey, knows_a_line_that_only_turns) {
  Point quarter;
  quarter[Axis::a] = 90;
  const SpeedReport report = report_of({motion_along(Curve::line(Point(), quarter), 3, 10,
                                                     {Phase{.duration = Seconds(9), .velocity = MmPerSecond(10)}})});
  ASSERT_FALSE(report.fastest.empty());
  EXPECT_TRUE(report.fastest[0].turns);
}

TEST(SpeedSurvey, gives_the_speed_of_a_surface_in_millimetres) {
  Point quarter;
  quarter[Axis::a] = 90;
  SurfaceScale surface;
  surface[Axis::a] = 0.5;  // mm per degree
  PlannedMove move = motion_along(Curve::line(Point(), quarter, surface), 3, 10,
                                  {Phase{.duration = Seconds(4.5), .velocity = MmPerSecond(10)}});
  move.segment.surface = surface;
  const SpeedReport report = report_of({move});
  ASSERT_FALSE(report.fastest.empty());
  EXPECT_FALSE(report.fastest[0].turns);
}

}  // namespace
}  // namespace passo
