#include "passo/judge/motion_trial.hpp"

#include "judged_program.hpp"

namespace passo {
namespace {

MotionProof proof_of(const test::JudgedProgram& program, const TrialWatchers& watchers = {}) {
  Diagnostics late;
  MotionProof proof = prove_motion(program.program.again(), program.machine, program.options,
                                   program.check.nominal_time, late, watchers);
  EXPECT_TRUE(late.all().empty()) << render(late, false);
  return proof;
}

TEST(MotionTrials, measure_the_motion_that_was_judged) {
  const test::JudgedProgram program(test::example_machine("bench"),
                                    "G21 G90 G64 P0.01\nG0 X10\nG1 X30 F1200\nG2 X30 Y0 I-5 J0\nG0 X0\nM2\n");
  const MotionProof proof = proof_of(program);
  EXPECT_TRUE(proof.good());
  EXPECT_NEAR(proof.time.value(), program.planned_time().value(), 1e-3);
  EXPECT_LE(proof.time_bound, proof.time) << "no motion on this path is faster";
}

TEST(MotionTrials, give_path_and_motion_to_who_watches) {
  const test::JudgedProgram program(test::example_machine("bench"), "G21 G90\nG1 X30 F1200\nM2\n");
  unsigned segments = 0;
  Seconds time{0};
  TrialWatchers watchers;
  watchers.path = [&](const PathItem& item) { segments += std::holds_alternative<Segment>(item) ? 1 : 0; };
  watchers.motion = [&](const MotionItem& item) {
    if (const auto* move = std::get_if<PlannedMove>(&item)) time += move->duration();
  };
  const MotionProof proof = proof_of(program, watchers);
  EXPECT_EQ(segments, 1U);
  EXPECT_NEAR(time.value(), proof.time.value(), 1e-3);
  EXPECT_EQ(proof.time, proof_of(program).time) << "watching changes nothing";
}

}  // namespace
}  // namespace passo
