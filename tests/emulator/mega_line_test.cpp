// The Mega's own firmware, emulated, at the end of a bad line: what comes out of its pins is the program, whatever the
// line does.
#include "emulator/emulated_line_run.hpp"
#include "kit/in_full.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

// The router of the Uno's example, with a Mega.
MachineDescription router() {
  MachineDescription machine = test::example_machine("uno");
  machine.board.highest_event_rate = Hertz(110'000);
  machine.board.held_items = 160;
  return machine;
}

const test::EmulatedLineRun& on_mega() {
  static const test::EmulatedLineRun run({"mega", PASSO_MOTION_MEGA}, router());
  return run;
}

class MegaOnABadLineInFull : public test::InFull<testing::Test> {};

TEST_F(MegaOnABadLineInFull, a_thousand_faults_of_each_kind) {
  on_mega().faults_of_each_kind(static_cast<int>(1000 / test::in_full()));
}

TEST_F(MegaOnABadLineInFull, cut_before_every_frame) {
  const test::EmulatedLineRun::Cuts cuts = on_mega().cut_at_every(test::in_full());
  EXPECT_EQ(cuts.recoveries_without_need, 0) << "there are places in plenty";
  EXPECT_GT(cuts.recoveries, 0);
}

TEST_F(MegaOnABadLineInFull, random_faults) {
  on_mega().random_faults(static_cast<int>(200 / test::in_full()));
}

}  // namespace
}  // namespace passo
