// The Uno's own firmware, emulated, at the end of a bad line: what comes out of its pins is the program, whatever the
// line does; and it rests where nothing more comes.
#include <cstdio>
#include <string>

#include "emulator/emulated_line_run.hpp"
#include "kit/in_full.hpp"
#include "kit/man_in_the_middle.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

const test::EmulatedLineRun& on_uno() {
  static const test::EmulatedLineRun run({"uno", PASSO_MOTION_UNO}, "uno");
  return run;
}

void cut_at_every(std::uint64_t stride) {
  const test::EmulatedLineRun::Cuts cuts = on_uno().cut_at_every(stride);
  EXPECT_GT(cuts.recoveries, cuts.trials / 2);
}

// The faults that a run gets depend on how the program is read ahead, and so on nothing but the seed.
void make_faults_of_each_kind(int wanted) {
  const std::uint64_t seed = test::seed();
  for (const test::Mischief mischief : test::every_mischief) {
    int faults = 0;
    int recoveries = 0;
    for (std::uint64_t i = 0; faults < wanted && !testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE(std::string(test::name_of(mischief)) + ", run " + std::to_string(i));
      test::ManInTheMiddle man(mischief, seed + i, 12, 400);
      recoveries +=
          on_uno()
              .run([&](test::BadLine& line) {
                line.set_trouble([&man](bool to_board, const test::Bytes& bytes) { return man(to_board, bytes); });
              })
              .recoveries;
      ASSERT_GT(man.faults_to_board, 0);
      faults += man.faults_to_board;
    }
    std::printf("%s: %d faults in frames to the board, %d rests\n", std::string(test::name_of(mischief)).c_str(),
                faults, recoveries);
  }
}

class UnoOnABadLineInFull : public test::InFull<testing::Test> {};

TEST(UnoOnABadLine, goes_on_from_where_it_rests_when_the_line_was_cut) {
  cut_at_every(37);
}

TEST(UnoOnABadLine, makes_no_wrong_step_of_random_faults) {
  on_uno().random_faults(5);
}

TEST(UnoOnABadLine, makes_no_wrong_step_of_a_man_in_the_middle) {
  make_faults_of_each_kind(15);
}

TEST_F(UnoOnABadLineInFull, a_thousand_faults_of_each_kind) {
  make_faults_of_each_kind(static_cast<int>(1000 / test::in_full()));
}

TEST_F(UnoOnABadLineInFull, cut_before_every_frame) {
  cut_at_every(test::in_full());
}

TEST_F(UnoOnABadLineInFull, random_faults) {
  on_uno().random_faults(static_cast<int>(400 / test::in_full()));
}

}  // namespace
}  // namespace passo
