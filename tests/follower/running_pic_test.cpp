// The PIC in gpsim, cut into pieces of time: it must do the same as in one run, but for a cycle at a cut.
#include "passo/emulator/running_pic.hpp"

#include <algorithm>
#include <cstdlib>

#include "follower/pic_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

std::filesystem::path folder_of(const std::string& test) {
  return std::filesystem::path(PASSO_IMAGES) / ("gpsim_" + test);
}

// Adds the vector's lines as they come, and runs the chip after each `piece`.
FollowerRun in_pieces(const FollowerVector& vector, Nanoseconds piece, int& pieces) {
  const std::vector<std::string> keys{"key.*"};
  auto pic = RunningPic::start(PicFollower::first_board, std::filesystem::path(PASSO_IMAGES) / "first_board.cod",
                               folder_of("pieces"), keys);
  if (!pic) throw std::runtime_error(pic.error());
  FollowerRun whole;
  auto next = vector.lines.begin();
  for (Nanoseconds end = piece; end < vector.end + piece; end += piece) {
    const Nanoseconds until = std::min(end, vector.end);
    const auto later = std::find_if(next, vector.lines.end(), [&](const LineChange& one) { return one.at >= until; });
    (*pic)->add({next, later});
    next = later;
    const auto run = until < vector.end ? (*pic)->run_before(until) : (*pic)->run_to(until);
    if (!run) throw std::runtime_error(run.error());
    EXPECT_LE((*pic)->now(), until);
    whole.changes.insert(whole.changes.end(), run->changes.begin(), run->changes.end());
    ++pieces;
  }
  return whole;
}

// The changes of one output.
std::vector<OutputChange> of_output(const FollowerRun& run, const std::string& output) {
  std::vector<OutputChange> changes;
  for (const OutputChange& change : run.changes) {
    if (change.output == output) changes.push_back(change);
  }
  return changes;
}

// Random steps of three motors, also at the same time, so densely that an edge lies near many a cut. A loop that is a
// cycle earlier may see an edge a turn later.
TEST(RunningPic, does_the_same_however_its_time_is_cut) {
  if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  const std::uint64_t seed = test::seed();
  const FollowerVector vector = after_automatic_key(random_steps(seed, 400, 15'000, Edges::apart), 5);
  const FollowerRun whole = run_on_pic(PicFollower::first_board, PASSO_IMAGES, vector, folder_of("whole"));
  EXPECT_GT(whole.changes.size(), 400U);
  int most_pieces = 0;
  for (const Nanoseconds piece : {700'000, 7'654'321, 50'000'000}) {
    int pieces = 0;
    const FollowerRun cut = in_pieces(vector, piece, pieces);
    most_pieces = std::max(most_pieces, pieces);
    for (const char* output : {"windings.x", "windings.y", "windings.z", "relay"}) {
      const auto same = [](const OutputChange& one, const OutputChange& other) {
        return one.value == other.value && std::abs(one.at - other.at) <= first_board_level;
      };
      EXPECT_TRUE(std::ranges::equal(of_output(whole, output), of_output(cut, output), same))
          << output << ", " << pieces << " pieces of " << piece << " ns, PASSO_SEED=" << seed;
    }
  }
  EXPECT_GT(most_pieces, 260);  // gpsim has 1024 break points, and a piece must not use up any
}

// The port's levels, the machine file and the manual are of one loop.
TEST(RunningPic, the_first_machine_gives_each_level_the_time_of_the_longest_turn) {
  const std::filesystem::path sources = PASSO_SOURCE_DIR;
  const std::string level = std::to_string(first_board_level / 1000);
  EXPECT_NE(text_of_file(sources / "docs/follower.md").find(", " + level + " with 1, 2, 3 motors at once | 13.9"),
            std::string::npos);
  const std::string machine = text_of_file(sources / "examples/machines/first-machine.toml");
  const std::string key = "\nstep_pulse_us = ";
  const std::size_t pulse = machine.find(key);
  ASSERT_NE(pulse, std::string::npos);
  EXPECT_GE(std::atoi(machine.c_str() + pulse + key.size()), first_board_level / 1000);
}

}  // namespace
}  // namespace passo
