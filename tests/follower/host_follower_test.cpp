// The portable follower against the vectors; and the vectors' own reading and judging.
#include "follower/host_follower.hpp"

#include <fstream>

#include "kit/scratch_folder.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

const std::filesystem::path root = PASSO_SOURCE_DIR;
const std::filesystem::path vectors = root / "tests/follower/vectors";

TEST(FollowerOnHost, does_what_every_vector_says) {
  const auto all = follower_vectors(vectors);
  EXPECT_GE(all.size(), 10U);
  for (const FollowerVector& vector : all) {
    EXPECT_EQ(difference(vector, run_on_host(vector), follower_outputs()), "") << vector.name;
  }
}

TEST(FollowerOnHost, does_it_however_fast_its_loop_turns) {
  for (const Nanoseconds turn : {2'000, 7'300, 23'000}) {
    for (const FollowerVector& vector : follower_vectors(vectors)) {
      EXPECT_EQ(difference(vector, run_on_host(vector, turn), follower_outputs()), "") << turn << " " << vector.name;
    }
  }
}

TEST(FollowerOnHost, has_the_customs_of_the_first_board) {
  const auto all = follower_vectors(vectors / "first_board");
  EXPECT_GE(all.size(), 4U);
  for (const FollowerVector& vector : all) {
    const std::vector<OutputChange> seen = run_first_board_on_host(vector);
    EXPECT_EQ(difference(vector, seen, first_board_outputs()), "") << vector.name;
  }
}

TEST(FollowerOnHost, loses_no_step_of_random_motion_while_no_level_is_shorter_than_a_turn) {
  const std::uint64_t seed = test::seed();
  const FollowerVector vector = random_steps(seed, 5'000, 10'000, Edges::apart);
  EXPECT_EQ(difference(vector, run_on_host(vector, 10'000), moved_outputs()), "") << "PASSO_SEED=" << seed;
  EXPECT_NE(difference(vector, run_on_host(vector, 11'000), moved_outputs()), "") << "a slower loop must lose some";
}

TEST(FollowerVectors, tell_what_differs) {
  FollowerVector vector{.name = "v"};
  vector.expected = {{{1000, "relay", "1"}, 500}};
  const std::vector<std::string> has = {"relay"};
  EXPECT_EQ(difference(vector, {{1000, "relay", "1"}}, has), "");
  EXPECT_EQ(difference(vector, {{1500, "relay", "1"}}, has), "");
  EXPECT_EQ(difference(vector, {{1501, "relay", "1"}}, has),
            "v: change 1 of relay: expected 1 from 1 us within 0.5 us, got 1 at 1.501 us");
  EXPECT_NE(difference(vector, {{999, "relay", "1"}}, has), "");
  EXPECT_NE(difference(vector, {{1200, "relay", "0"}}, has), "");
  EXPECT_NE(difference(vector, {}, has), "");
  EXPECT_NE(difference(vector, {{1200, "relay", "1"}, {1300, "relay", "0"}}, has), "");
  EXPECT_EQ(difference(vector, {{7, "indicator.relay", "1"}}, {}), "") << "this board has none";
}

TEST(FollowerVectors, say_where_their_text_is_wrong) {
  const std::filesystem::path file = test::scratch_folder() / "vector.txt";
  for (const char* wrong :
       {"1000 in clock.x", "1000 in clock.x 2", "1000 out relay 1", "1000 maybe relay 1", "drive"}) {
    std::ofstream(file) << "# comment\n" << wrong << "\n2000 end\n";
    try {
      read_follower_vector(file);
      FAIL() << wrong;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(", line 2: expected"), std::string::npos) << error.what();
    }
  }
  std::ofstream(file) << "1000 in clock.x 1\n";
  EXPECT_THROW(read_follower_vector(file), std::runtime_error) << "it has no end";
}

}  // namespace
}  // namespace passo
