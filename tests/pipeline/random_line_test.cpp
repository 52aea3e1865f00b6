// Random programs on random machines whose board is at the other end of a bad line: every step as without the line.
//
// PASSO_SEED=S PASSO_RUNS=N random_line_tests takes the programs S to S + N - 1.
#include <cstdio>

#include "kit/line_run.hpp"
#include "kit/random_gcode.hpp"

namespace passo {
namespace {

constexpr int most_touches = 2;

struct Sums {
  std::uint64_t frames = 0;
  int faults = 0;
  int recoveries = 0;
};

void expect_every_step(std::uint64_t number, const test::RandomJob& job, test::Random& random, Sums& sums) {
  MachineDescription machine = job.machine;
  machine.board.held_items = random.chance(0.5) ? 240 : 31;
  const test::Outcome reference = test::run(machine, job.program, false);
  const test::Outcome whole = test::run(machine, job.program, true);
  test::expect_same_way(whole.steps, reference.steps, most_touches);
  test::RandomTrouble trouble(number);
  const auto cut_at = static_cast<std::uint64_t>(random.between(0, static_cast<double>(whole.frames)));
  const double cut_for = random.between(0.02, 0.6);
  const test::Outcome troubled =
      test::run(machine, job.program, true,
                [&](test::DrivenProgram& running, std::uint64_t frame, bool to_board, const test::Bytes& bytes) {
                  if (frame == cut_at) running.line().cut(running.machine().elapsed(), Seconds(cut_for));
                  return trouble(to_board, bytes);
                });
  test::expect_same_way(troubled.steps, reference.steps, most_touches);
  test::expect_within_limits(machine, troubled.steps);
  sums.frames += troubled.frames;
  sums.faults += trouble.faults;
  sums.recoveries += troubled.recoveries;
}

TEST(RandomLine, faults_and_cuts_change_no_step) {
  Sums sums;
  test::for_each_job(test::fewer(30, 4), [&](std::uint64_t number, const test::RandomJob& job, test::Random& random) {
    expect_every_step(number, job, random, sums);
  });
  std::printf("%llu frames, %d faults, %d recoveries from a tail\n", static_cast<unsigned long long>(sums.frames),
              sums.faults, sums.recoveries);
}

TEST(RandomLine, faults_and_cuts_change_no_step_with_start_stop_velocities) {
  Sums sums;
  const auto try_one = [&](std::uint64_t number, const test::RandomJob& job, test::Random& random) {
    expect_every_step(number, job, random, sums);
  };
  test::for_each_job(test::fewer(15, 4), try_one, test::Machines::starting);
  std::printf("%llu frames, %d faults, %d recoveries from a tail\n", static_cast<unsigned long long>(sums.frames),
              sums.faults, sums.recoveries);
}

// With limits of jerk, torque curves and backlash on any of the axes, and lines that mostly turn.
TEST(RandomLine, faults_and_cuts_change_no_step_on_machines_of_all_mixtures) {
  Sums sums;
  const auto try_one = [&](std::uint64_t number, const test::RandomJob& job, test::Random& random) {
    expect_every_step(number, job, random, sums);
  };
  test::for_each_job(test::fewer(15, 4), try_one, test::Machines::of_all_mixtures);
  std::printf("%llu frames, %d faults, %d recoveries from a tail\n", static_cast<unsigned long long>(sums.frames),
              sums.faults, sums.recoveries);
}

// Dust on a board with few places: the limit of speed was lowered in motion, and the motion could not follow.
TEST(RandomLine, changes_no_step_in_a_program_that_once_failed) {
  constexpr std::uint64_t number = 2026113738;
  test::Random random = test::Random::of(number);
  const test::RandomJob job(random);
  Sums sums;
  expect_every_step(number, job, random, sums);
}

}  // namespace
}  // namespace passo
