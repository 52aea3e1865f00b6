// The line to the board breaks, loses, doubles, flips and swaps: the machine stays on the path and within its limits,
// rests where nothing more comes, and ends where it would have ended.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/line_run.hpp"
#include "kit/line_trouble.hpp"
#include "kit/seed.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::Bytes;
using test::DrivenProgram;
using test::expect_same_way;
using test::expect_within_limits;
using test::RandomTrouble;
using test::run;

// With places in plenty, and with few; "smooth_" before it: with limits of jerk.
const MachineDescription& machine_named(const std::string& name) {
  static std::map<std::string, MachineDescription> known;
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  const std::string smooth = "smooth_";
  const MachineDescription machine = name.starts_with(smooth)
                                         ? test::with_jerk_limits(test::example_machine(name.substr(smooth.size())))
                                         : test::example_machine(name);
  return known.emplace(name, machine).first->second;
}

const std::vector<std::string>& programs() {
  static const std::vector<std::string> all = {
      "G21 G90 G1 F4000\nX6\nY4\nX1 Y6 Z-1\nX0 Y0 Z0\nM2\n",
      "G21 G90 G64 P.02 F3000 M3 S1000\nG2 X6 Y0 I3 J0\nG3 X9 I1.5\nG1 X4 Y3\nM8\nG4 P.05\nG0 X0 Y0 Z2\nM5 M9\nM2\n",
      "G21 G90 F900\nG0 X3 Y3\nG81 Z-2 R1\nX6 Y2\nG80\nG61.1 G1 X8 Y8 F5000\nX4\nG64 Y1\nM2\n",
      "G21 G90 F6000\nG1 X10\nX0\nX10 Y1\nX0 Y2\nM2\n",
  };
  return all;
}

const test::Outcome& reference_of(const std::string& machine, std::size_t program) {
  static std::map<std::pair<std::string, std::size_t>, test::Outcome> known;
  const auto found = known.find({machine, program});
  if (found != known.end()) return found->second;
  return known.emplace(std::pair(machine, program), run(machine_named(machine), programs()[program], false))
      .first->second;
}

void expect_as_if_nothing_had_been(const std::string& machine, std::size_t program, const test::Outcome& outcome) {
  expect_same_way(outcome.steps, reference_of(machine, program).steps);
  expect_within_limits(machine_named(machine), outcome.steps);
}

// Cuts at every `stride`-th frame from either side. Returns how many trials that were.
int cut_at_frame_boundaries(const std::string& machine, std::size_t program, std::uint64_t stride,
                            const std::vector<double>& lasting, int& recoveries) {
  const test::Outcome whole = run(machine_named(machine), programs()[program], true);
  expect_as_if_nothing_had_been(machine, program, whole);
  int trials = 0;
  for (const double seconds : lasting) {
    for (std::uint64_t at = 0; at < whole.frames; at += stride) {
      SCOPED_TRACE(machine + ", program " + std::to_string(program) + ", cut before frame " + std::to_string(at) +
                   " for " + std::to_string(seconds) + " s");
      const test::Outcome cut = run(machine_named(machine), programs()[program], true,
                                    [&](DrivenProgram& job, std::uint64_t number, bool, Bytes bytes) {
                                      if (number == at) job.line().cut(job.machine().elapsed(), Seconds(seconds));
                                      return bytes;
                                    });
      expect_as_if_nothing_had_been(machine, program, cut);
      recoveries += cut.recoveries;
      ++trials;
      if (testing::Test::HasFatalFailure()) return trials;
    }
  }
  return trials;
}

// PASSO_TRIAL: from that one on.
void random_faults(const std::string& machine, int trials) {
  const std::uint64_t seed = test::seed();
  const char* const first = std::getenv("PASSO_TRIAL");
  int faults = 0;
  int recoveries = 0;
  std::uint64_t most_frames = 0;
  for (int i = first == nullptr ? 0 : std::atoi(first); i < trials; ++i) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + ", trial " + std::to_string(i));
    const std::size_t program = static_cast<std::size_t>(i) % programs().size();
    RandomTrouble trouble(seed + static_cast<std::uint64_t>(i));
    const test::Outcome outcome =
        run(machine_named(machine), programs()[program], true,
            [&](DrivenProgram&, std::uint64_t, bool to_board, const Bytes& bytes) { return trouble(to_board, bytes); });
    expect_as_if_nothing_had_been(machine, program, outcome);
    faults += trouble.faults;
    recoveries += outcome.recoveries;
    most_frames = std::max(most_frames, outcome.frames);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_TRUE(first != nullptr || faults > trials) << faults;
  std::printf("%d trials with %d faults, %d recoveries from a tail, at most %llu frames\n", trials, faults, recoveries,
              static_cast<unsigned long long>(most_frames));
}

// As if the CRC had been deceived: one of the frames to the board is another, and has a right one.
void forge_frames(const std::string& machine, std::size_t program, std::uint64_t stride) {
  const test::Outcome whole = run(machine_named(machine), programs()[program], true);
  int trials = 0;
  int recoveries = 0;
  for (std::uint64_t at = 0; at < whole.frames; at += stride) {
    SCOPED_TRACE(machine + ", program " + std::to_string(program) + ", frame " + std::to_string(at) + " forged");
    bool forged = false;
    const test::Outcome outcome = run(machine_named(machine), programs()[program], true,
                                      [&](DrivenProgram&, std::uint64_t number, bool to_board, Bytes bytes) {
                                        if (forged || number < at || !to_board) return bytes;
                                        const std::optional<Bytes> other =
                                            test::forged(bytes, static_cast<std::uint8_t>(number));
                                        forged = other.has_value();
                                        return other.value_or(bytes);
                                      });
    expect_as_if_nothing_had_been(machine, program, outcome);
    recoveries += outcome.recoveries;
    ++trials;
    if (testing::Test::HasFatalFailure()) return;
  }
  std::printf("%d frames that were never sent, %d recoveries from a tail\n", trials, recoveries);
}

class BrokenLine : public testing::TestWithParam<std::string> {};
class BrokenLineInFull : public test::InFull<testing::TestWithParam<std::string>> {};

TEST_P(BrokenLine, every_frame_boundary_in_part) {
  int recoveries = 0;
  const int trials = cut_at_frame_boundaries(GetParam(), 1, 11 * test::one_in(8), {0.5}, recoveries);
  std::printf("%d trials, %d recoveries from a tail\n", trials, recoveries);
  EXPECT_GT(recoveries, trials / 2);
}

TEST_P(BrokenLine, random_faults_in_part) {
  random_faults(GetParam(), test::fewer(40, 8));
}

TEST_P(BrokenLine, what_was_never_sent_moves_nothing) {
  forge_frames(GetParam(), 1, 23 * test::one_in(8));
}

TEST_P(BrokenLineInFull, every_frame_boundary) {
  int trials = 0;
  int recoveries = 0;
  for (std::size_t program = 0; program < programs().size(); ++program) {
    trials += cut_at_frame_boundaries(GetParam(), program, test::in_full(), {0.05, 0.2, 0.5}, recoveries);
    if (HasFatalFailure()) return;
  }
  std::printf("%d trials, %d recoveries from a tail\n", trials, recoveries);
  EXPECT_GE(trials * static_cast<int>(test::in_full()), 5000);
}

// PASSO_RUNS: how many runs.
TEST_P(BrokenLineInFull, random_faults) {
  const char* const runs = std::getenv("PASSO_RUNS");
  random_faults(GetParam(), runs != nullptr ? std::atoi(runs) : 4000);
}

INSTANTIATE_TEST_SUITE_P(Board, BrokenLine, testing::Values("router", "uno", "smooth_router", "smooth_uno"));
INSTANTIATE_TEST_SUITE_P(Board, BrokenLineInFull, testing::Values("router", "uno", "smooth_router", "smooth_uno"));

}  // namespace
}  // namespace passo
