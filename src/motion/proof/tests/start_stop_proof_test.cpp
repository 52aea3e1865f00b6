// The referee where axes start and stop at a velocity of their own.
#include <cmath>

#include "proof_kit.hpp"

#include "passo/proof/proof_text.hpp"

namespace passo::test {
namespace {

// --- Jumps of the velocity at rests, up to the start-stop velocity.

constexpr double start_stop = 5;

MotionProof proof_with_starts(const std::vector<MotionItem>& planned) {
  ProofOptions starting = options();
  for (ProvenAxis& axis : starting.axes) axis.start_stop = MmPerSecond(start_stop);
  MotionProver prover(starting);
  for (const MotionItem& one : planned) {
    if (const auto* action = std::get_if<Action>(&one)) {
      prover.watch(PathItem(*action));
    } else {
      prover.watch(PathItem(std::get<PlannedMove>(one).segment));
    }
    prover.watch(one);
  }
  return prover.finish();
}

TEST(MotionProofOfStarts, a_start_and_a_stop_at_the_velocity_are_good_and_one_percent_more_is_a_fault) {
  const Segment segment = line(xyz(0, 0), xyz(1, 0));
  const MotionProof proof = proof_with_starts({steady(segment, start_stop)});
  EXPECT_TRUE(proof.good()) << to_text(proof);
  EXPECT_NEAR(proof.axes[0].velocity_jump.multiple(), 1, 1e-12);
  EXPECT_FALSE(proof_of({steady(segment, start_stop)}).good());
  const MotionProof faster = proof_with_starts({steady(segment, 1.01 * start_stop)});
  ASSERT_EQ(faster.faults().size(), 1U);
  EXPECT_EQ(faster.faults()[0], "axis X velocity jumps: 5.05, limit 5 (line 1, at 0.000000 s)");
}

TEST(MotionProofOfStarts, within_a_segment_nothing_may_jump) {
  const Segment segment = line(xyz(0, 0), xyz(2, 0));
  EXPECT_FALSE(proof_with_starts({move(segment, {phase(0.25, 0, 4, 0), phase(0.2, 1, 5, 0)})}).good());
}

TEST(MotionProofOfStarts, a_corner_may_be_passed_where_no_axis_jumps_by_more) {
  const Segment first = line(xyz(0, 0), xyz(1, 0));
  EXPECT_TRUE(proof_with_starts({steady(first, 5), steady(line(xyz(1, 0), xyz(1, 1)), 5)}).good());
  EXPECT_FALSE(proof_with_starts({steady(first, 5), steady(line(xyz(1, 0), xyz(1, 1)), 5.05)}).good());
  const Segment back = line(xyz(1, 0), xyz(0, 0));
  EXPECT_TRUE(proof_with_starts({steady(first, 2.5), steady(back, 2.5)}).good());
  EXPECT_FALSE(proof_with_starts({steady(first, 2.55), steady(back, 2.5)}).good());
}

// An action that takes no time is no rest between a stop and a start the other way.
TEST(MotionProofOfStarts, an_action_parts_a_stop_from_a_start_by_its_time) {
  const PlannedMove there = steady(line(xyz(0, 0), xyz(1, 0)), 5);
  const PlannedMove back = steady(line(xyz(1, 0), xyz(0, 0)), 5);
  const auto proof = [&](double dwell) {
    return proof_with_starts({there, Action{.kind = Action::Kind::dwell, .dwell = Seconds(dwell)}, back});
  };
  EXPECT_FALSE(proof(0).good());
  EXPECT_TRUE(proof(0.5).good());
}

TEST(MotionProofOfStarts, the_bound_starts_and_ends_at_the_velocity) {
  const double top = std::sqrt(start_stop * start_stop + 500 * 8.0);
  const double ramp = (top - start_stop) / 500;
  const PlannedMove planned =
      move(line(xyz(0, 0), xyz(8, 0)), {phase(ramp, 0, start_stop, 500), phase(ramp, 4, top, -500)});
  const MotionProof proof = proof_with_starts({planned});
  EXPECT_TRUE(proof.good()) << to_text(proof);
  EXPECT_NEAR(proof.time_bound.value(), proof.time.value(), 1e-5 * proof.time.value());
  EXPECT_LE(proof.time_bound.value(), proof.time.value());
}

// Two corners: a right angle, and one that turns back.
TEST(MotionProofOfStarts, the_bound_passes_corners_at_the_velocity) {
  const MotionProof proof =
      proof_with_starts({steady(line(xyz(0, 0), xyz(1e-3, 0)), 5), steady(line(xyz(1e-3, 0), xyz(1e-3, 1e-3)), 5),
                         steady(line(xyz(1e-3, 1e-3), xyz(1e-3, 0)), 5)});
  // From 5 mm/s up and down to it again, on each line.
  const double top = std::sqrt(25 + 500 * 1e-3);
  const double least = 3 * 2 * (top - 5) / 500;
  EXPECT_NEAR(proof.time_bound.value(), least, 1e-4 * least);
  EXPECT_LE(proof.time_bound.value(), least);
}

}  // namespace
}  // namespace passo::test
