// Homing over a bad line: at rest, within the limits, and homed to the step, whatever the line does.
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <utility>

#include "kit/in_full.hpp"
#include "kit/line_trouble.hpp"
#include "kit/stage_test.hpp"
#include "pipeline/homing_kit.hpp"

namespace passo {
namespace {

using test::Distances;
using test::expect_homed;
using test::Homed;
using test::homing_machine;
using test::RandomTrouble;
using test::StepLog;

using Bytes = VirtualLine::Bytes;
using Trouble = std::function<Bytes(VirtualMachine&, VirtualLine&, std::uint64_t number, bool to_board, Bytes bytes)>;

Homed home(const MachineDescription& machine, const Distances& distances, const LineOptions& options,
           const Trouble& trouble) {
  IdealPlant plant = test::plant_with(test::switches_of(machine, distances));
  test::DrivenHoming homing(machine, {.line = options, .plant = &plant});
  VirtualMachine& board = homing.machine();
  VirtualLine& line = homing.line();
  StepLog log;
  board.add_observer(log);
  Homed result;
  line.set_trouble([&](bool to_board, Bytes bytes) {
    const std::uint64_t number = result.frames++;
    return trouble ? trouble(board, line, number, to_board, std::move(bytes)) : bytes;
  });
  while (homing.advance()) {
  }
  test::note(homing, result);
  result.steps = log.steps;
  for (std::size_t m = 0; m < 3; ++m) result.counts[m] = board.counts().motors[m].position;
  EXPECT_TRUE(board.board().idle());
  EXPECT_EQ(board.board().size(), 0U) << "a refill that was broken off may wait, and is never played";
  test::expect_within_limits(machine, log.steps);
  return result;
}

// Near, for many trials; Z stands on its switch.
const Distances near{.steps = {800, 500, -60}};

constexpr const char* boards[] = {"router", "uno"};

TEST(HomingOverALine, is_exact_at_every_speed_of_the_line) {
  for (const char* name : boards) {
    const MachineDescription machine = homing_machine(name);
    for (const double baud : {115'200.0, 250'000.0, 500'000.0, 1'000'000.0}) {
      SCOPED_TRACE(name + std::string(" at ") + std::to_string(baud));
      const Distances distances{.steps = {4000, 3000, 2000}};
      const Homed result = home(machine, distances, {.baud = baud}, nullptr);
      expect_homed(machine, distances, result);
      const double overrun = test::expect_small_overrun(machine, distances, result);
      std::printf("%s, %.0f baud: at most %.1f ms ahead, %d rests, %.2f mm from contact to rest at 20 mm/s\n", name,
                  baud, 1000 * result.longest_ahead.value(), result.recoveries, overrun);
    }
  }
}

void cut_before_frames(const char* name, std::uint64_t stride) {
  const MachineDescription machine = homing_machine(name);
  const Homed whole = home(machine, near, {}, nullptr);
  int trials = 0;
  int recoveries = 0;
  for (const double seconds : {0.02, 0.5}) {
    for (std::uint64_t at = 0; at < whole.frames && !testing::Test::HasFailure(); at += stride, ++trials) {
      SCOPED_TRACE(name + std::string(", cut before frame ") + std::to_string(at) + " for " + std::to_string(seconds));
      const Homed cut = home(machine, near, {},
                             [&](VirtualMachine& board, VirtualLine& line, std::uint64_t number, bool, Bytes bytes) {
                               if (number == at) line.cut(board.elapsed(), Seconds(seconds));
                               return bytes;
                             });
      expect_homed(machine, near, cut);
      recoveries += cut.recoveries;
    }
  }
  std::printf("%s: %llu frames, %d cuts, %d recoveries from a tail\n", name,
              static_cast<unsigned long long>(whole.frames), trials, recoveries);
  EXPECT_GT(recoveries, trials / 8);
}

void random_faults(const char* name, int trials) {
  const MachineDescription machine = homing_machine(name);
  const std::uint64_t seed = test::seed();
  int faults = 0;
  int recoveries = 0;
  for (int i = 0; i < trials && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(name + std::string(", PASSO_SEED=") + std::to_string(seed) + ", trial " + std::to_string(i));
    RandomTrouble trouble(seed + static_cast<std::uint64_t>(i));
    const Homed result =
        home(machine, near, {}, [&](VirtualMachine&, VirtualLine&, std::uint64_t, bool to_board, const Bytes& bytes) {
          return trouble(to_board, bytes);
        });
    expect_homed(machine, near, result);
    faults += trouble.faults;
    recoveries += result.recoveries;
  }
  std::printf("%s: %d trials with %d faults, %d recoveries from a tail\n", name, trials, faults, recoveries);
  EXPECT_GT(faults, trials);
}

class HomingOnABadLine : public testing::TestWithParam<const char*> {};
class HomingOnABadLineInFull : public test::InFull<testing::TestWithParam<const char*>> {};

TEST_P(HomingOnABadLine, cut_in_part) {
  cut_before_frames(GetParam(), 29 * test::one_in(2));
}
TEST_P(HomingOnABadLine, random_faults_in_part) {
  random_faults(GetParam(), test::fewer(20));
}
TEST_P(HomingOnABadLineInFull, cut_before_every_frame) {
  cut_before_frames(GetParam(), test::in_full());
}
TEST_P(HomingOnABadLineInFull, random_faults) {
  random_faults(GetParam(), static_cast<int>(1000 / test::in_full()));
}
INSTANTIATE_TEST_SUITE_P(Board, HomingOnABadLine, testing::ValuesIn(boards));
INSTANTIATE_TEST_SUITE_P(Board, HomingOnABadLineInFull, testing::ValuesIn(boards));

// The line never comes back: the machine rests, and the host says so.
TEST(HomingOverALine, ends_in_words_when_the_line_is_gone) {
  const MachineDescription machine = homing_machine();
  const Homed gone =
      home(machine, near, {}, [&](VirtualMachine& board, VirtualLine& line, std::uint64_t number, bool, Bytes bytes) {
        if (number == 100) line.cut(board.elapsed(), Seconds(INFINITY));
        return bytes;
      });
  EXPECT_FALSE(gone.done);
  EXPECT_EQ(gone.error, LinkError::no_answer);
}

}  // namespace
}  // namespace passo
