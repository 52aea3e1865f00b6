// The images for the Uno and the Mega against the vectors, and at the highest rate that docs/follower.md promises.
#include "follower/avr_follower.hpp"

#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

const std::filesystem::path vectors = std::filesystem::path(PASSO_SOURCE_DIR) / "tests/follower/vectors";
const AvrBoard uno = {"uno", "atmega328p", &uno_follower, PASSO_IMAGES "/follower_uno"};
const AvrBoard mega = {"mega", "atmega2560", &mega_follower, PASSO_IMAGES "/follower_mega"};

TEST(FollowerOnAvr, does_what_every_vector_says_on_the_mega) {
  for (const FollowerVector& vector : follower_vectors(vectors)) {
    EXPECT_EQ(difference(vector, run_on_avr(mega, vector), follower_outputs()), "");
  }
}

TEST(FollowerOnAvr, does_what_every_vector_without_keys_says_on_the_uno) {
  int played = 0;
  for (const FollowerVector& vector : follower_vectors(vectors)) {
    if (vector.needs_keypad()) continue;
    EXPECT_EQ(difference(vector, run_on_avr(uno, vector), moved_outputs()), "");
    ++played;
  }
  EXPECT_GE(played, 5);
}

TEST(FollowerOnAvr, loses_no_step_while_each_level_lasts_as_long_as_the_manual_says) {
  const std::uint64_t seed = test::seed();
  const FollowerVector on_uno = random_steps(seed, 3'000, PASSO_UNO_SHORTEST);
  EXPECT_EQ(difference(on_uno, run_on_avr(uno, on_uno), moved_outputs()), "") << "PASSO_SEED=" << seed;
  const FollowerVector on_mega = random_steps(seed, 3'000, PASSO_MEGA_SHORTEST);
  EXPECT_EQ(difference(on_mega, run_on_avr(mega, on_mega), moved_outputs()), "") << "PASSO_SEED=" << seed;
}

}  // namespace
}  // namespace passo
