#include "passo/verdict/margin_survey.hpp"

#include <cmath>
#include <numbers>

#include "flat_motor.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

// That motor, with no tolerance but what is given.
SurveyedMotor flat_motor(Axis axis, double tolerance = 0, double friction = 0, double weight = 0) {
  MotorSetup setup = test::flat_setup();
  setup.load.friction = {friction};
  setup.weight = {weight};
  return surveyed_motor(axis, setup, tolerance, test::flat_radians_per_mm, {1000});
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

// Speeds up with that torque at the shaft of X, goes on for a while, and slows down.
PlannedMove there_and_rest(std::uint32_t line, double torque, double seconds = 0.03) {
  const double a = test::flat_acceleration(torque);
  const double v = a * seconds;
  const double first = v * seconds / 2;
  return straight(line, at(1000, 0),
                  {{.duration = Seconds(seconds), .acceleration = MmPerSecond2(a)},
                   {.duration = Seconds(seconds), .start = Mm(first), .velocity = MmPerSecond(v)},
                   {.duration = Seconds(seconds),
                    .start = Mm(3 * first),
                    .velocity = MmPerSecond(v),
                    .acceleration = MmPerSecond2(-a)}});
}

Verdict verdict_of(const SurveyedMotor& motor, const PlannedMove& move) {
  MarginSurvey survey({motor});
  survey.watch(move);
  return survey.verdict().verdict;
}

// From rest to T the swing needs 1.38·T. These motors hardly damp their ringing, and each jump of the torque may add to
// it. The weakest motor has 0.95·0.85 N·m.
TEST(MarginSurvey, calls_safe_doubtful_and_lost) {
  const SurveyedMotor motor = flat_motor(Axis::x, 0.15);
  EXPECT_EQ(verdict_of(motor, there_and_rest(1, 0.3)), Verdict::safe);
  EXPECT_EQ(verdict_of(motor, there_and_rest(1, 0.6)), Verdict::doubtful);
  EXPECT_EQ(verdict_of(motor, there_and_rest(1, 0.9)), Verdict::lost);
  EXPECT_EQ(verdict_of(motor, there_and_rest(1, 1.4)), Verdict::lost);
}

// 5 mm a turn: 1 N is 0.796 mN·m. At 39.8 mm/s, 10 N for each mm/s are 398 N, or 0.317 N·m.
TEST(MarginSurvey, feels_the_cut_on_feeds) {
  const SurveyedMotor motor = flat_motor(Axis::x, 0.15);
  PlannedMove move = there_and_rest(3, 0.05, 0.1);
  const auto with_cut = [&](double newtons_per_speed) {
    MarginSurvey survey({motor});
    survey.set_cut(newtons_per_speed);
    survey.watch(move);
    return survey.verdict();
  };
  const MarginVerdict gentle = with_cut(10);
  EXPECT_EQ(gentle.verdict, Verdict::safe);
  ASSERT_TRUE(gentle.axes.at(0).worst);
  EXPECT_NEAR(gentle.axes[0].worst->of_cut.value, 0.317, 1e-3);
  EXPECT_EQ(with_cut(40).verdict, Verdict::lost) << "1.27 N\u00B7m of 1";
  move.segment.rapid = true;
  EXPECT_EQ(with_cut(40).verdict, Verdict::safe) << "a rapid does not cut";
}

TEST(MarginSurvey, needs_inertia_friction_and_weight) {
  MarginSurvey survey({flat_motor(Axis::x, 0, 0.1, 0.2)});
  Phase steady{.duration = Seconds(0.1),
               .velocity = MmPerSecond(10),
               .acceleration = MmPerSecond2(test::flat_acceleration(0.3))};
  survey.watch(straight(7, at(1000, 0), {steady}));
  const MarginVerdict up = survey.verdict();
  ASSERT_TRUE(up.axes.at(0).worst);
  const SurveyedMotor motor = flat_motor(Axis::x);
  const double damping = motor.load.friction_per_speed.value * 10 * motor.radians_per_unit;
  EXPECT_NEAR(up.axes[0].worst->of_motion.value, 0.3 + 0.1 + 0.2 + damping, 1e-9);
  EXPECT_EQ(up.axes[0].worst->line, 7U);

  MarginSurvey other({flat_motor(Axis::x, 0, 0.1, 0.2)});
  other.watch(straight(7, at(-1000, 0), {steady}));
  EXPECT_NEAR(other.verdict().axes[0].worst->of_motion.value, 0.3 + 0.1 - 0.2 + damping, 1e-9);
}

// A rotor that lacks torque for a moment only lags. The first move is over after a full step.
TEST(MarginSurvey, a_short_excess_does_not_lose_a_step) {
  EXPECT_NE(verdict_of(flat_motor(Axis::x), there_and_rest(1, 1.3, 0.0012)), Verdict::lost);
  EXPECT_EQ(verdict_of(flat_motor(Axis::x), there_and_rest(1, 1.3, 0.006)), Verdict::lost);
}

TEST(MarginSurvey, counts_what_turns_the_path) {
  MarginSurvey survey({flat_motor(Axis::x), flat_motor(Axis::y)});
  PlannedMove move;
  Segment segment;
  segment.curve = Curve::arc(at(10, 0), at(-10, 0), Axis::x, Axis::y, 0, 0, std::numbers::pi);
  segment.source.line = 3;
  move.begin_on(segment);
  const double speed = std::sqrt(10 * test::flat_acceleration(0.4));
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
      survey.watch(there_and_rest(line, 0.01 * line));
      survey.watch(Action{.dwell = Seconds(1)});
    }
  }
  const MarginVerdict verdict = survey.verdict();
  ASSERT_EQ(verdict.worst.size(), MarginSurvey::most_worst);
  for (std::size_t i = 0; i < verdict.worst.size(); ++i) EXPECT_EQ(verdict.worst[i].line, 30 - i);
  EXPECT_FALSE(verdict.axes.at(1).worst);
}

TEST(MarginSurvey, cures_a_line_so_that_it_is_safe) {
  const SurveyedMotor motor = flat_motor(Axis::x, 0.15, 0.1);  // with friction, so that one swing fades before the next
  for (const double torque : {0.7, 1.4}) {
    MarginSurvey before({motor});
    before.watch(there_and_rest(1, torque));
    const MarginVerdict verdict = before.verdict();
    ASSERT_NE(verdict.verdict, Verdict::safe);
    ASSERT_TRUE(verdict.worst.at(0).safe_acceleration) << torque;
    const double cured = verdict.worst[0].safe_acceleration->value() / test::flat_acceleration(1);
    EXPECT_EQ(verdict_of(motor, there_and_rest(1, 0.999 * cured)), Verdict::safe) << torque;
    EXPECT_NE(verdict_of(motor, there_and_rest(1, 1.2 * cured)), Verdict::safe) << torque;
  }
}

}  // namespace
}  // namespace passo
