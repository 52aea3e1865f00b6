// One law for every machine, whatever limits it has on which axes: the motion takes at most 1.2 times the prover's
// bound.
//
// PASSO_SEED=S PASSO_RUNS=N random_motion_tests --gtest_filter=MixtureLaw.* takes the programs S to S + N - 1, and
// scripts/mixture_table.sh prints the distribution of thousands.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include "kit/job_rows.hpp"
#include "kit/meddled_run.hpp"

namespace passo {
namespace {

constexpr double most_of_least_time = 1.2;

// Shorter programs are not compared with the law: a thousandth of a second of their time is a ten-thousandth of a job.
constexpr Seconds shortest{1};

std::vector<std::string> faults_of(const MotionProof& proof) {
  std::vector<std::string> faults = proof.faults();
  if (proof.time.value() < proof.time_bound.value() * (1 - 1e-6)) faults.push_back("faster than the bound");
  if (proof.time.value() < proof.tube_bound.value() * (1 - 1e-6)) faults.push_back("faster than the bound in the tube");
  if (proof.time > shortest && proof.times_bound() > most_of_least_time) {
    faults.push_back(fmt::format("{:.4f} times the bound", proof.times_bound()));
  }
  return faults;
}

std::string row_of(std::uint64_t number, const test::RandomJob& job) {
  const std::clock_t begin = std::clock();
  const MotionProof proof = test::run(job.program, job.machine, {.live = endless_commitment}).proof;
  const double effort = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
  for (const AxisProof& axis : proof.axes) {
    velocity = std::max(velocity, axis.velocity.multiple());
    acceleration = std::max(acceleration, axis.acceleration.multiple());
    jerk = std::max(jerk, axis.jerk.multiple());
  }
  std::string faults = fmt::format("{}", fmt::join(faults_of(proof), "; "));
  if (testing::Test::HasFailure()) faults += "; a failed expectation";
  return fmt::format("time\t{}\t{}\t{:.6f}\t{:.6f}\t{:.6f}\t{:.3f}\t{:.6f}\t{:.6f}\t{:.6f}\t{:.6f}\t{:.6f}\t{}\n",
                     number, test::mixture_of(job.machine), proof.time.value(), proof.times_bound(),
                     proof.times_tube_bound(), effort, velocity, acceleration, jerk, proof.feed.multiple(),
                     proof.deviation.multiple(), faults);
}

TEST(MixtureLaw, the_time_is_at_most_a_fifth_above_the_bound) {
  constexpr auto machines = test::Machines::of_any_limits;
  if (test::prints_rows()) {
    return test::print_job_rows(
        machines, [](std::uint64_t number, const test::RandomJob& job, test::Random&) { return row_of(number, job); });
  }
  test::for_each_job(
      test::fewer(100, 4),
      [](std::uint64_t, const test::RandomJob& job, test::Random&) {
        const MotionProof proof = test::run(job.program, job.machine, {.live = endless_commitment}).proof;
        for (const std::string& fault : faults_of(proof)) ADD_FAILURE() << fault;
      },
      machines);
}

// Two programs: an axis became the fastest at a line of its grid, while rounding had put it before that line, and there
// were events without end. One program: rounding left a line of 1e-15 mm between two stops.
TEST(MixtureLaw, holds_in_programs_that_once_failed) {
  for (const std::uint64_t number : {8000133U, 9202901U, 9201357U}) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(number));
    test::Random random = test::Random::of(number);
    const test::RandomJob job = test::RandomJob::of_any_limits(number, random);
    const MotionProof proof = test::run(job.program, job.machine, {.live = endless_commitment}).proof;
    for (const std::string& fault : proof.faults()) ADD_FAILURE() << fault;
  }
}

// Stops on bends, with start-stop velocities and a jerk limit on one axis. These programs took 1.65 and 1.28 times the
// bound when the speed at a stop was that of the guess, and the motion began without acceleration along the path.
TEST(MixtureLaw, chooses_the_speed_at_a_stop_on_a_bend) {
  for (const std::uint64_t number : {9200548U, 9500498U}) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(number));
    test::Random random = test::Random::of(number);
    const test::RandomJob job = test::RandomJob::of_any_limits(number, random);
    const MotionProof proof = test::run(job.program, job.machine, {.live = endless_commitment}).proof;
    for (const std::string& fault : proof.faults()) ADD_FAILURE() << fault;
    EXPECT_LT(proof.times_bound(), 1.09);
  }
}

}  // namespace
}  // namespace passo
