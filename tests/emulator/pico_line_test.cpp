// The Pico's own firmware, emulated, at the end of a bad line by USB: what comes out of its pins is the program,
// whatever the line does.
#include <algorithm>
#include <string>

#include "emulator/emulated_line_run.hpp"
#include "kit/in_full.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::pico;

const test::EmulatedLineRun& on_pico() {
  static const test::EmulatedLineRun run(pico, test::example_machine("pico"));
  return run;
}

class PicoOnABadLine : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = test::missing(pico); !why.empty()) GTEST_SKIP() << why;
  }
};

void pico_cut_at_every(std::uint64_t stride) {
  const test::EmulatedLineRun::Cuts cuts = on_pico().cut_at_every(stride);
  EXPECT_EQ(cuts.recoveries_without_need, 0) << "there are places in plenty";
  EXPECT_GT(cuts.recoveries, 0);
}

TEST_F(PicoOnABadLine, goes_on_from_where_it_rests_when_the_line_was_cut) {
  pico_cut_at_every(97);
}

TEST_F(PicoOnABadLine, makes_no_wrong_step_of_random_faults) {
  on_pico().random_faults(2);
}

using PicoOnABadLineInFull = test::InFull<PicoOnABadLine>;
TEST_F(PicoOnABadLineInFull, a_thousand_faults_of_each_kind) {
  on_pico().faults_of_each_kind(static_cast<int>(1000 / test::in_full()));
}

TEST_F(PicoOnABadLineInFull, cut_before_every_frame) {
  pico_cut_at_every(std::min<std::uint64_t>(3 * test::in_full(), 97));
}

TEST_F(PicoOnABadLineInFull, random_faults) {
  on_pico().random_faults(static_cast<int>(200 / test::in_full()));
}

}  // namespace
}  // namespace passo
