// The images for the PIC16F877A against the vectors, and at the highest rate that docs/follower.md promises.
#include <algorithm>

#include "follower/pic_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

const std::filesystem::path root = PASSO_SOURCE_DIR;
const std::filesystem::path vectors = root / "tests/follower/vectors";

std::filesystem::path work_of(const std::string& test) {
  return std::filesystem::path(PASSO_IMAGES) / ("gpsim_" + test);
}

TEST(FollowerOnPic, does_what_every_vector_says) {
  if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  for (const FollowerVector& vector : follower_vectors(vectors)) {
    const auto seen = run_on_pic(PicFollower::at_20_mhz, PASSO_IMAGES, vector, work_of(vector.name));
    EXPECT_EQ(difference(vector, seen.changes, follower_outputs()), "");
  }
}

// The manual's highest rate: a level that lasts so long is longer than any turn of the loop.
TEST(FollowerOnPic, loses_no_step_while_each_level_lasts_as_long_as_the_manual_says) {
  if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  EXPECT_NE(text_of_file(root / "docs/follower.md").find("| PIC16F877A | 15.0 "), std::string::npos);
  const std::uint64_t seed = test::seed();
  for (const Edges edges : {Edges::together, Edges::apart}) {
    FollowerVector vector = random_steps(seed, 2'000, 15'000, edges);
    add_fidgeting(vector, seed);
    const FollowerRun run = run_on_pic(PicFollower::at_20_mhz, PASSO_IMAGES, vector, work_of("random"), Turns::watched);
    EXPECT_EQ(difference(vector, run.changes, moved_outputs()), "") << "PASSO_SEED=" << seed;
    EXPECT_LT(run.longest_turn, 75U);
  }
}

TEST(FollowerOnPic, hears_the_keypad_while_three_motors_step_at_the_highest_rate) {
  if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  const FollowerVector vector = manual_mode_at_full_rate(15'000);
  const FollowerRun run = run_on_pic(PicFollower::at_20_mhz, PASSO_IMAGES, vector, work_of("full_rate"));
  EXPECT_EQ(difference(vector, run.changes, {"indicator.manual"}), "");
}

TEST(FirstBoard, does_what_its_own_vectors_say) {
  if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  int played = 0;
  for (const FollowerVector& vector : follower_vectors(vectors / "first_board")) {
    const FollowerRun run = run_on_pic(PicFollower::first_board, PASSO_IMAGES, vector, work_of("first_" + vector.name));
    EXPECT_EQ(difference(vector, run.changes, first_board_outputs()), "");
    ++played;
  }
  EXPECT_GE(played, 4);
}

// Once somebody has pressed `*`, the lines mean the same to all boards.
TEST(FirstBoard, does_after_the_automatic_key_what_every_vector_of_lines_alone_says) {
  if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  int played = 0;
  for (const FollowerVector& vector : follower_vectors(vectors)) {
    const auto is_reset = [](const LineChange& change) { return change.line == "reset" || change.at == 0; };
    if (vector.needs_keypad() || vector.drive != "two_on" || std::ranges::any_of(vector.lines, is_reset)) continue;
    const FollowerVector later = after_automatic_key(vector, 5);
    const FollowerRun run = run_on_pic(PicFollower::first_board, PASSO_IMAGES, later, work_of("first_" + vector.name));
    EXPECT_EQ(difference(later, run.changes, moved_outputs()), "");
    ++played;
  }
  EXPECT_GE(played, 4);
}

TEST(FirstBoard, loses_no_step_while_each_level_lasts_as_long_as_the_manual_says) {
  if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  EXPECT_NE(text_of_file(root / "docs/follower.md").find("| first board | 75.0 "), std::string::npos);
  const std::uint64_t seed = test::seed();
  for (const Edges edges : {Edges::together, Edges::apart}) {
    FollowerVector vector = after_automatic_key(random_steps(seed, 1'000, 15'000, edges), 5);
    add_fidgeting(vector, seed);
    const FollowerRun run =
        run_on_pic(PicFollower::first_board, PASSO_IMAGES, vector, work_of("first_random"), Turns::watched);
    EXPECT_EQ(difference(vector, run.changes, moved_outputs()), "") << "PASSO_SEED=" << seed;
    EXPECT_LT(run.longest_turn, 75U);
  }
}

}  // namespace
}  // namespace passo
