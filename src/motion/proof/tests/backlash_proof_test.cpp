#include "proof_kit.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::line;
using test::move;
using test::phase;
using test::triangle;
using test::xyz;

constexpr double backlash = 0.2;

ProofOptions options_with_backlash() {
  ProofOptions options = test::options();
  options.axes[0].backlash = Mm(backlash);
  return options;
}

// The motor of X moves from one side of its backlash to the other, while the tool stands at `at`.
PlannedMove take_up(double at, bool down, double part = 1) {
  Segment segment = line(xyz(down ? at + part * backlash : at - part * backlash, 0), xyz(at, 0));
  segment.mode = PathMode::exact_stop;
  segment.takes_up_backlash = true;
  if (down) segment.downs.add(Axis::x);
  return triangle(segment, 500);
}
PlannedMove there(double from, double to, bool down) {
  Segment segment = line(xyz(from, 0), xyz(to, 0));
  segment.mode = PathMode::exact_stop;
  if (down) segment.downs.add(Axis::x);
  return triangle(segment, 500);
}

MotionProof proof_with_backlash(const std::vector<PlannedMove>& planned) {
  MotionProver prover(options_with_backlash());
  for (const PlannedMove& one : planned) {
    if (one.segment.takes_up_backlash) continue;
    Segment programmed = one.segment;
    programmed.downs = AxisSet();
    prover.watch(PathItem(programmed));
  }
  for (const PlannedMove& one : planned) prover.watch(MotionItem(one));
  return prover.finish();
}

TEST(MotionProofOfBacklash, a_reversal_whose_backlash_is_taken_up_is_good) {
  const MotionProof proof =
      proof_with_backlash({there(0, 5, false), take_up(5, true), there(5, 1, true), take_up(1, false)});
  EXPECT_TRUE(proof.good()) << proof.faults()[0];
  EXPECT_LT(proof.axes[0].lost_motion.value, 1e-9);
  EXPECT_NEAR(proof.times_bound(), 1, 1e-6) << "the path stops for each of them";
}

TEST(MotionProofOfBacklash, finds_a_reversal_whose_backlash_is_not_taken_up) {
  const MotionProof proof = proof_with_backlash({there(0, 5, false), there(5, 1, false)});
  EXPECT_NEAR(proof.axes[0].lost_motion.value, backlash, 1e-12);
  ASSERT_EQ(proof.faults().size(), 1U);
  EXPECT_TRUE(proof.faults()[0].starts_with("axis X backlash that is not taken up: 0.2"));
}

TEST(MotionProofOfBacklash, finds_a_motor_that_jumps_over_its_backlash) {
  const MotionProof proof = proof_with_backlash({there(0, 5, false), there(5, 1, true)});
  EXPECT_NEAR(proof.gap.value, backlash, 1e-12);
  EXPECT_FALSE(proof.good());
}

TEST(MotionProofOfBacklash, finds_half_of_the_backlash) {
  EXPECT_FALSE(proof_with_backlash({there(0, 5, false), take_up(5, true, 0.5), there(5, 1, true)}).good());
}

// X rises to its extreme and falls again on a parabola 0.01 mm high, while Y moves by 2 mm. On this path, the motor of
// X takes up a part of the backlash.
PlannedMove turn_in_motion(double part, double height = 0.01) {
  const double length = 2;
  const double slope = 4 * height / length;
  const double rise = part * backlash;
  Segment segment = line(xyz(5, 0), xyz(5, length));
  segment.curve =
      Curve::cubic(xyz(5 + backlash, 0), xyz(slope, 1), xyz(5 + backlash - rise, length), xyz(-slope, 1), Mm(length));
  segment.mode = PathMode::exact_stop;
  segment.downs.add(Axis::x);
  segment.lead = MotorLead{.axis = Axis::x, .start = backlash, .end = backlash - rise};
  return triangle(segment, 100);
}

MotionProof proof_of_turn(double part, double height = 0.01) {
  MotionProver prover(options_with_backlash());
  Segment up = line(xyz(0, 0), xyz(5, 0));
  Segment over = line(xyz(5, 0), xyz(5, 2));
  Segment down = line(xyz(5, 2), xyz(1, 2));
  for (Segment* one : {&up, &over, &down}) {
    one->mode = PathMode::exact_stop;
    one->tolerance = Mm(0.01);
    prover.watch(PathItem(*one));
  }
  prover.watch(MotionItem(triangle(up, 500)));
  prover.watch(MotionItem(turn_in_motion(part, height)));
  down.downs.add(Axis::x);
  prover.watch(MotionItem(triangle(down, 500)));
  return prover.finish();
}

TEST(MotionProofOfBacklash, follows_the_tool_while_backlash_is_taken_up_in_motion) {
  const MotionProof proof = proof_of_turn(1);
  EXPECT_TRUE(proof.good()) << proof.faults()[0];
  EXPECT_LT(proof.axes[0].lost_motion.value, 1e-9);
  EXPECT_LT(proof.deviation.value, 0.01) << "the axis stands before its extreme";
  EXPECT_GT(proof.deviation.value, 0);
}

TEST(MotionProofOfBacklash, finds_a_tool_that_leaves_the_path_while_backlash_is_taken_up_in_motion) {
  const MotionProof proof = proof_of_turn(1, 0.2);
  EXPECT_GT(proof.deviation.value, 0.01);
  EXPECT_FALSE(proof.good());
}

TEST(MotionProofOfBacklash, finds_backlash_of_which_a_part_is_taken_up_in_motion) {
  EXPECT_FALSE(proof_of_turn(0.9).good());
}

// Parts of an arc, the last of them as short as rounding. The bound counted the arc twice.
TEST(MotionProofOfBacklash, an_arc_whose_last_part_is_rounding_is_bounded_once) {
  Segment whole = test::circle(10, 0.25, 10);
  whole.mode = PathMode::exact_stop;
  const double length = whole.curve.length().value();
  const double end = length * (1 - 1e-14);
  PlannedMove first = move(whole, {phase(end / 10, 0, 10, 0)});
  first.to = Mm(end);
  PlannedMove rest = move(whole, {phase((length - end) / 10, end, 10, 0)});
  MotionProver prover(test::options());
  prover.watch(MotionItem(first));
  prover.watch(MotionItem(rest));
  EXPECT_NEAR(prover.finish().time_bound.value(), test::bound_of({whole}), 1e-9);
}

}  // namespace
}  // namespace passo
