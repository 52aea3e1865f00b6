// The Uno's own firmware, emulated, at the end of a bad line: what comes out of its pins is the program, whatever the
// line does; and it rests where nothing more comes.
#include "emulator/emulated_line_run.hpp"
#include "kit/in_full.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

const test::EmulatedLineRun& on_uno() {
  static const test::EmulatedLineRun run({"uno", PASSO_MOTION_UNO}, test::example_machine("uno"));
  return run;
}

void uno_cut_at_every(std::uint64_t stride) {
  const test::EmulatedLineRun::Cuts cuts = on_uno().cut_at_every(stride);
  EXPECT_GT(cuts.recoveries, cuts.trials / 2);
}

class UnoOnABadLineInFull : public test::InFull<testing::Test> {};

TEST(UnoOnABadLine, goes_on_from_where_it_rests_when_the_line_was_cut) {
  uno_cut_at_every(37);
}

TEST(UnoOnABadLine, makes_no_wrong_step_of_random_faults) {
  on_uno().random_faults(5);
}

TEST(UnoOnABadLine, makes_no_wrong_step_of_a_man_in_the_middle) {
  on_uno().faults_of_each_kind(15);
}

TEST_F(UnoOnABadLineInFull, a_thousand_faults_of_each_kind) {
  on_uno().faults_of_each_kind(static_cast<int>(1000 / test::in_full()));
}

TEST_F(UnoOnABadLineInFull, cut_before_every_frame) {
  uno_cut_at_every(test::in_full());
}

TEST_F(UnoOnABadLineInFull, random_faults) {
  on_uno().random_faults(static_cast<int>(400 / test::in_full()));
}

}  // namespace
}  // namespace passo
