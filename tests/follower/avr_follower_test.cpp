// The images for the Uno and the Mega against the vectors, and at the highest rate that docs/follower.md promises.
#include "follower/avr_follower.hpp"

#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

const std::filesystem::path root = PASSO_SOURCE_DIR;
const std::filesystem::path vectors = root / "tests/follower/vectors";
const AvrBoard uno = {"uno", "atmega328p", &uno_follower, PASSO_IMAGES "/follower_uno"};
const AvrBoard mega = {"mega", "atmega2560", &mega_follower, PASSO_IMAGES "/follower_mega"};

TEST(FollowerOnAvr, does_what_every_vector_says_on_the_mega) {
  for (const FollowerVector& vector : follower_vectors(vectors)) {
    EXPECT_EQ(difference(vector, run_on_avr(mega, vector).changes, follower_outputs()), "");
  }
}

TEST(FollowerOnAvr, does_what_every_vector_without_keys_says_on_the_uno) {
  int played = 0;
  for (const FollowerVector& vector : follower_vectors(vectors)) {
    if (vector.needs_keypad()) continue;
    EXPECT_EQ(difference(vector, run_on_avr(uno, vector).changes, moved_outputs()), "");
    ++played;
  }
  EXPECT_GE(played, 5);
}

// The same in a program of its own, as `passo follower sim` starts it.
TEST(FollowerOnAvr, does_the_same_in_lock_step_with_another_program) {
  const std::filesystem::path images = PASSO_IMAGES;
  for (const FollowerVector& vector : follower_vectors(vectors)) {
    const std::string mega_name = "mega_" + vector.drive;
    const auto run = run_follower(mega_name, images / follower_image(mega_name), vector.lines, vector.end);
    ASSERT_TRUE(run) << run.error();
    EXPECT_EQ(difference(vector, run->changes, outputs_of_follower(mega_name)), "");
    if (vector.needs_keypad()) continue;
    const std::string uno_name = "uno_" + vector.drive;
    const auto small = run_follower(uno_name, images / follower_image(uno_name), vector.lines, vector.end);
    ASSERT_TRUE(small) << small.error();
    EXPECT_EQ(difference(vector, small->changes, outputs_of_follower(uno_name)), "");
  }
}

void expect_no_step_lost(const AvrBoard& board, Nanoseconds shortest) {
  const std::uint64_t seed = test::seed();
  for (const Edges edges : {Edges::together, Edges::apart}) {
    FollowerVector vector = random_steps(seed, 3'000, shortest, edges);
    add_fidgeting(vector, seed);
    const FollowerRun run = run_on_avr(board, vector);
    EXPECT_EQ(difference(vector, run.changes, moved_outputs()), "") << board.name << " PASSO_SEED=" << seed;
    EXPECT_LT(run.longest_turn, static_cast<std::uint64_t>(shortest) * 16 / 1000) << board.name;
  }
}

// The manual's highest rates: a level that lasts so long is longer than any turn of the loop.
TEST(FollowerOnAvr, loses_no_step_while_each_level_lasts_as_long_as_the_manual_says) {
  const std::string manual = text_of_file(root / "docs/follower.md");
  if (manual.find("compiled by " PASSO_CHIP_COMPILER) == std::string::npos) {
    GTEST_SKIP() << "the figures are another compiler's than " PASSO_CHIP_COMPILER;
  }
  EXPECT_NE(manual.find("| Uno | 6.0 "), std::string::npos);
  expect_no_step_lost(uno, 6'000);
  EXPECT_NE(manual.find("| Mega | 7.0 "), std::string::npos);
  expect_no_step_lost(mega, 7'000);
}

TEST(FollowerOnAvr, hears_the_keypad_while_three_motors_step_at_the_highest_rate) {
  const FollowerVector vector = manual_mode_at_full_rate(7'000);
  EXPECT_EQ(difference(vector, run_on_avr(mega, vector).changes, {"indicator.manual"}), "");
}

}  // namespace
}  // namespace passo
