#include "passo/verdict/tolerance_trial.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "flat_motor.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::flat_setup;

ToleranceTrial trial_of(const MotorSetup& setup) {
  return ToleranceTrial(setup, 0.15, test::flat_radians_per_mm, {300});
}

// From `place`, at `speed`, with that torque at the shaft.
AxisPiece piece_of(double seconds, double torque, double place = 0, double speed = 0) {
  const double a = test::flat_acceleration(torque);
  return {.duration = Seconds(seconds),
          .from = place,
          .to = place + speed * seconds + a * seconds * seconds / 2,
          .speed_from = speed,
          .speed_to = speed + a * seconds,
          .load = torque};
}

AxisPiece after(const AxisPiece& piece, double seconds, double torque) {
  return piece_of(seconds, torque, piece.to, piece.speed_to);
}

TEST(ToleranceTrial, tells_how_many_motors_lose_steps) {
  // The swing from rest to T needs 1.38·T.
  for (const auto& [torque, lost] : {std::pair{0.5, 0}, {0.65, 3}, {0.7, 4}, {0.78, 5}, {0.9, 6}}) {
    ToleranceTrial trial = trial_of(flat_setup());
    const TrialFinding finding = trial.play(piece_of(0.03, torque));
    EXPECT_TRUE(finding.judged);
    EXPECT_EQ(finding.lost, lost) << torque;
    EXPECT_EQ(finding.usual_out, lost >= 5) << torque;
  }
}

TEST(ToleranceTrial, swings_as_far_as_the_equal_area_criterion_says) {
  ToleranceTrial trial = trial_of(flat_setup());
  const TrialFinding finding = trial.play(piece_of(0.03, 0.4));
  // The weakest motor: P·(1 − cos δ) = T·δ.
  const double most = 0.95 * 0.85;
  double lag = 0.5;
  for (int i = 0; i < 100; ++i) lag = std::acos(1 - 0.4 * lag / most);
  EXPECT_NEAR(finding.most_swing, lag * 2 / std::numbers::pi, 0.05);
}

// Motors that have lost steps take part again after a rest.
TEST(ToleranceTrial, begins_anew_after_a_rest) {
  ToleranceTrial trial = trial_of(flat_setup());
  EXPECT_TRUE(trial.play(piece_of(0.03, 1.4)).usual_out);
  trial.stand(Seconds(1));
  EXPECT_TRUE(trial.usual_lost());
  const TrialFinding after_rest = trial.play(piece_of(0.03, 0.5));
  EXPECT_EQ(after_rest.lost, 0);
  EXPECT_FALSE(after_rest.usual_out);
}

TEST(ToleranceTrial, leaves_out_what_repeats_itself) {
  ToleranceTrial trial = trial_of(flat_setup());
  const AxisPiece start = piece_of(0.03, 0.3);
  trial.play(start);
  const AxisPiece steady = after(start, 600, 0);
  EXPECT_EQ(trial.play(steady).lost, 0);
  EXPECT_EQ(trial.play(after(steady, 0.03, -0.3)).lost, 0) << "the slowing down fits on";
  EXPECT_LT(trial.played(), Seconds(1.2));
}

// An hour of the same kind, then what is new: that is played, from mid-motion.
TEST(ToleranceTrial, plays_what_is_new_in_a_long_program) {
  ToleranceTrial trial = trial_of(flat_setup());
  AxisPiece piece = piece_of(0.02, 0.1);
  trial.play(piece);
  for (int i = 0; i < 90'000; ++i) {
    piece = after(piece, 0.02, i % 2 == 0 ? 0.1 : -0.1);
    const TrialFinding finding = trial.play(piece);
    ASSERT_TRUE(finding.judged);
    ASSERT_EQ(finding.lost, 0) << i;
  }
  EXPECT_LT(trial.played(), Seconds(90));
  const AxisPiece mild = after(piece, 0.05, 0.45);
  EXPECT_EQ(trial.play(mild).lost, 0);
  const AxisPiece wild = after(mild, 0.05, 1.3);
  EXPECT_EQ(trial.play(wild).lost, 6);
}

// After a minute only what is new is played, here the braking of a short motion. What was before is played with it.
TEST(ToleranceTrial, enters_a_motion_with_the_swing_that_it_has) {
  MotorSetup setup = flat_setup();
  setup.load.friction = {0.1};  // so that it soon rests
  ToleranceTrial trial = trial_of(setup);
  const auto play_stroke = [&](double torque, double braking) {
    AxisPiece piece = piece_of(0.005, torque);
    int lost = trial.play(piece).lost;
    piece = piece_of(0.005 * torque / braking, -braking, piece.to, piece.speed_to);
    lost += trial.play(piece).lost;
    return lost + trial.stand(Seconds(0.6)).lost;
  };
  const int whole = play_stroke(0.3, 0.2);
  ASSERT_EQ(whole, 0);
  for (int i = 0; i < 7000; ++i) ASSERT_EQ(play_stroke(0.3, 0.3), 0);
  EXPECT_EQ(play_stroke(0.3, 0.2), whole);
}

// What nobody played is not known.
TEST(ToleranceTrial, says_what_it_did_not_play) {
  ToleranceTrial trial = trial_of(flat_setup());
  const auto random_torque = [](int i) { return 0.3 * std::sin(0.7 * i); };
  AxisPiece piece = piece_of(0.02, 0.1);
  for (int i = 0; i < 20'000; ++i) {
    trial.play(piece);
    piece = after(piece, 0.02, random_torque(i));
    if (std::abs(piece.speed_to) > 200) piece = piece_of(0.02, 0);
  }
  EXPECT_LE(trial.played(), Seconds(120.1));
}

}  // namespace
}  // namespace passo
