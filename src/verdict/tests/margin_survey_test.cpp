#include "passo/verdict/margin_survey.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr double radians_per_mm = 2 * std::numbers::pi / 5;
constexpr double inertia = 1e-4;

// 1 N·m at all rates, no friction but what is given, no tolerance but what is given.
SurveyedMotor flat_motor(Axis axis, double tolerance = 0, double friction = 0, double weight = 0) {
  const auto curve = TorqueCurve::from_points({.steps_per_revolution = 200, .inertia = {inertia}},
                                              {{Hertz(0), {1.0}}, {Hertz(1e5), {0.999999}}});
  const MotorSetup setup = measured_setup(*curve, *Excitation::named("microsteps:8"));
  return {.axis = axis,
          .band = TorqueBand(setup, tolerance, {0}),
          .load = {.friction = {friction}},
          .inertia = inertia,
          .weight = weight,
          .radians_per_unit = radians_per_mm};
}

double acceleration_for(double torque) {
  return torque / inertia / radians_per_mm;
}

PlannedMove straight(std::uint32_t line, const Point& end, std::initializer_list<Phase> phases) {
  PlannedMove move;
  Segment segment;
  segment.curve = Curve::line({}, end);
  segment.source.line = line;
  move.begin_on(segment);
  for (const Phase& phase : phases) move.add(phase);
  return move;
}

Point at(double x, double y) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  return point;
}

// Speeds up with that torque at the shaft of X for 50 ms.
PlannedMove speeding_up(std::uint32_t line, double torque) {
  return straight(line, at(1000, 0),
                  {{.duration = Seconds(0.05), .acceleration = MmPerSecond2(acceleration_for(torque))}});
}

TEST(MarginSurvey, calls_safe_doubtful_and_lost) {
  const auto verdict_of = [](double torque) {
    MarginSurvey survey({flat_motor(Axis::x, 0.15)});
    survey.watch(speeding_up(1, torque));
    return survey.verdict().verdict;
  };
  EXPECT_EQ(verdict_of(0.5), Verdict::safe);
  EXPECT_EQ(verdict_of(0.6), Verdict::doubtful);  // the swing of the start needs 0.83 of 0.82
  EXPECT_EQ(verdict_of(0.9), Verdict::doubtful);  // and here 1.24 of 1.22
  EXPECT_EQ(verdict_of(1.1), Verdict::lost);      // a strong motor does not catch the swing either
  EXPECT_EQ(verdict_of(1.4), Verdict::lost);
}

TEST(MarginSurvey, needs_inertia_friction_and_weight) {
  MarginSurvey survey({flat_motor(Axis::x, 0, 0.1, 0.2)});
  Phase steady{
      .duration = Seconds(0.1), .velocity = MmPerSecond(10), .acceleration = MmPerSecond2(acceleration_for(0.3))};
  survey.watch(straight(7, at(1000, 0), {steady}));
  const MarginVerdict up = survey.verdict();
  ASSERT_TRUE(up.axes.at(0).worst);
  EXPECT_NEAR(up.axes[0].worst->of_motion.value, 0.3 + 0.1 + 0.2, 1e-9);
  EXPECT_EQ(up.axes[0].worst->line, 7U);

  MarginSurvey other({flat_motor(Axis::x, 0, 0.1, 0.2)});
  other.watch(straight(7, at(-1000, 0), {steady}));
  EXPECT_NEAR(other.verdict().axes[0].worst->of_motion.value, 0.3 + 0.1 - 0.2, 1e-9);
}

TEST(MarginSurvey, a_short_excess_does_not_lose_a_step) {
  const auto verdict_of = [](double seconds) {
    MarginSurvey survey({flat_motor(Axis::x)});
    survey.watch(straight(1, at(1000, 0),
                          {{.duration = Seconds(seconds), .acceleration = MmPerSecond2(acceleration_for(1.3))}}));
    return survey.verdict().verdict;
  };
  // 0.24 N·m too much move the rotor a full step, 0.0314 rad, in 5.1 ms.
  EXPECT_EQ(verdict_of(0.004), Verdict::doubtful);
  EXPECT_EQ(verdict_of(0.006), Verdict::lost);
}

TEST(MarginSurvey, counts_what_turns_the_path) {
  MarginSurvey survey({flat_motor(Axis::x), flat_motor(Axis::y)});
  PlannedMove move;
  Segment segment;
  segment.curve = Curve::arc(at(10, 0), at(-10, 0), Axis::x, Axis::y, 0, 0, std::numbers::pi);
  segment.source.line = 3;
  move.begin_on(segment);
  const double speed = std::sqrt(10 * acceleration_for(0.4));
  move.add({.duration = segment.curve.length() / MmPerSecond(speed), .velocity = MmPerSecond(speed)});
  survey.watch(move);
  const MarginVerdict verdict = survey.verdict();
  EXPECT_NEAR(verdict.axes.at(0).worst->of_motion.value, 0.4, 1e-3);
  EXPECT_NEAR(verdict.axes.at(1).worst->of_motion.value, 0.4, 1e-2);
}

TEST(MarginSurvey, keeps_the_ten_worst_lines_each_once) {
  MarginSurvey survey({flat_motor(Axis::x), flat_motor(Axis::y)});
  for (int pass = 0; pass < 2; ++pass) {
    for (std::uint32_t line = 1; line <= 30; ++line) {
      survey.watch(speeding_up(line, 0.01 * line));
      survey.watch(Action{.dwell = Seconds(1)});
    }
  }
  const MarginVerdict verdict = survey.verdict();
  ASSERT_EQ(verdict.worst.size(), MarginSurvey::most_worst);
  for (std::size_t i = 0; i < verdict.worst.size(); ++i) EXPECT_EQ(verdict.worst[i].line, 30 - i);
  EXPECT_FALSE(verdict.axes.at(1).worst);
}

TEST(MarginSurvey, cures_a_doubtful_line_so_that_it_is_safe) {
  MarginSurvey survey({flat_motor(Axis::x, 0.15)});
  survey.watch(speeding_up(1, 0.8));
  const MarginVerdict before = survey.verdict();
  ASSERT_EQ(before.verdict, Verdict::doubtful);
  ASSERT_TRUE(before.worst.at(0).safe_acceleration);
  const double cured = before.worst[0].safe_acceleration->value();
  MarginSurvey again({flat_motor(Axis::x, 0.15)});
  again.watch(speeding_up(1, 0.999 * cured * inertia * radians_per_mm));
  EXPECT_EQ(again.verdict().verdict, Verdict::safe);
  MarginSurvey more({flat_motor(Axis::x, 0.15)});
  more.watch(speeding_up(1, 1.01 * cured * inertia * radians_per_mm));
  EXPECT_EQ(more.verdict().verdict, Verdict::doubtful);
}

}  // namespace
}  // namespace passo
