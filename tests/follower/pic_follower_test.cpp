// The image for the PIC16F877A against the vectors, and at the highest rate that docs/follower.md promises.
#include "follower/pic_follower.hpp"

#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

const std::filesystem::path vectors = std::filesystem::path(PASSO_SOURCE_DIR) / "tests/follower/vectors";

std::filesystem::path work_of(const std::string& test) {
  return std::filesystem::path(PASSO_IMAGES) / ("gpsim_" + test);
}

TEST(FollowerOnPic, does_what_every_vector_says) {
  if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  for (const FollowerVector& vector : follower_vectors(vectors)) {
    const auto seen = run_on_pic(PASSO_IMAGES "/follower_pic", vector, work_of(vector.name));
    EXPECT_EQ(difference(vector, seen, follower_outputs()), "");
  }
}

TEST(FollowerOnPic, loses_no_step_while_each_level_lasts_as_long_as_the_manual_says) {
  if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  const std::uint64_t seed = test::seed();
  const FollowerVector vector = random_steps(seed, 1'500, PASSO_PIC_SHORTEST);
  const auto seen = run_on_pic(PASSO_IMAGES "/follower_pic", vector, work_of("random"));
  EXPECT_EQ(difference(vector, seen, moved_outputs()), "") << "PASSO_SEED=" << seed;
}

}  // namespace
}  // namespace passo
