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
  EXPECT_NE(text_of_file(root / "docs/follower.md").find("| PIC16F877A | 7.2, 7.8, 9.6 "), std::string::npos);
  const std::uint64_t seed = test::seed();
  for (const Edges edges : {Edges::together, Edges::apart}) {
    FollowerVector vector = random_steps(seed, 2'000, 9'600, edges);
    add_fidgeting(vector, seed);
    const FollowerRun run = run_on_pic(PicFollower::at_20_mhz, PASSO_IMAGES, vector, work_of("random"), Turns::watched);
    EXPECT_EQ(difference(vector, run.changes, moved_outputs()), "") << "PASSO_SEED=" << seed;
    EXPECT_LE(run.longest_turn, 47U);
  }
}

TEST(FollowerOnPic, hears_the_keypad_while_three_motors_step_at_the_highest_rate) {
  if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  const FollowerVector vector = manual_mode_at_full_rate(9'600);
  const FollowerRun run = run_on_pic(PicFollower::at_20_mhz, PASSO_IMAGES, vector, work_of("full_rate"));
  EXPECT_EQ(difference(vector, run.changes, {"indicator.manual"}), "");
}

}  // namespace
}  // namespace passo
