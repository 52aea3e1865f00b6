// Random programs on random machines, from text to steps, each measured by the referee: no limit exceeded on any axis,
// no place off the path, the steps those of the motion, the end where the program says, and not slower than it must be.
//
// PASSO_SEED=S PASSO_RUNS=N random_motion_tests takes the programs S to S + N - 1. Each depends on its number alone.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "kit/meddled_run.hpp"
#include "kit/random_gcode.hpp"

#include "passo/proof/proof_text.hpp"

namespace passo {
namespace {

// No motion is faster than the bound, but for what the digits of a long job leave.
constexpr double rounding = 1e-6;

// Without limits of jerk: the worst of 3,000 programs took 1.0097 times the bound.
constexpr double most_of_bound = 1.015;

// How much longer than the bound they took, of those of more than a second.
struct Slowness {
  std::vector<double> of_all;
  double least = INFINITY;  // of short ones too
  double worst = 1;
  std::uint64_t worst_seed = 0;

  void add(const MotionProof& proof, std::uint64_t seed) {
    if (proof.time > Seconds(0)) least = std::min(least, proof.times_bound());
    if (proof.time < Seconds(1)) return;
    of_all.push_back(proof.times_bound());
    if (of_all.back() > worst) {
      worst = of_all.back();
      worst_seed = seed;
    }
  }
  void print(const char* name) {
    if (of_all.empty()) return;
    std::ranges::sort(of_all);
    const auto at = [this](double share) {
      return of_all[static_cast<std::size_t>(share * static_cast<double>(of_all.size() - 1))];
    };
    std::printf("%s: %zu of more than a second, T/bound least %.6f, median %.4f, 99 %% %.4f, worst %.4f (%llu)\n", name,
                of_all.size(), least, at(0.5), at(0.99), worst, static_cast<unsigned long long>(worst_seed));
  }
};

void expect_end(const test::Ending& ending, const MachineDescription& machine) {
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const double place = ending.place[machine.axes[m].axis] * machine.axes[m].steps_per_unit;
    EXPECT_NEAR(static_cast<double>(ending.motors[m].position), place, 0.5 + 1e-6) << "motor " << m;
  }
}

TEST(RandomMotion, keeps_limits_and_path_and_is_nearly_the_fastest) {
  Slowness with_jerk;
  Slowness without_jerk;
  std::uint64_t moves = 0;
  double seconds = 0;
  test::for_each_job(100, [&](std::uint64_t number, const test::RandomJob& job, test::Random&) {
    const test::Ending ending = test::run(job.program, job.machine, {.live = {}});
    for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
    expect_end(ending, job.machine);
    EXPECT_GE(ending.proof.time.value(), ending.proof.time_bound.value() * (1 - rounding));
    if (!has_jerk_limit(job.machine)) {
      EXPECT_LE(ending.proof.time.value(), ending.proof.time_bound.value() * most_of_bound);
    }
    if (test::number_of("PASSO_RUNS", 0) == 1) std::printf("%s", to_text(ending.proof).c_str());
    (has_jerk_limit(job.machine) ? with_jerk : without_jerk).add(ending.proof, number);
    moves += ending.proof.moves;
    seconds += ending.proof.time.value();
  });
  std::printf("%llu moves, %.0f s of motion\n", static_cast<unsigned long long>(moves), seconds);
  without_jerk.print("acceleration limited");
  with_jerk.print("jerk limited");
}

// A machine whose axes are all alike.
MachineDescription even_machine(std::initializer_list<Axis> axes, double steps, MmPerSecond velocity,
                                MmPerSecond2 acceleration) {
  MachineDescription machine;
  for (const Axis axis : axes) {
    AxisDescription& own = machine.axes.emplace_back();
    own.axis = axis;
    own.steps_per_unit = steps;
    own.travel_low = -1e4;
    own.travel_high = 1e4;
    own.velocity = velocity;
    own.acceleration = acceleration;
  }
  machine.board.highest_event_rate = Hertz(1e6);
  return machine;
}

// Where a rotary axis turns fast for each millimetre in one move, and is all that moves in the next, its slope changes
// so much in the corner that the acceleration along the path is ten times its own.
TEST(RotaryCorners, are_passed_nearly_as_fast_as_can_be) {
  MachineDescription machine = even_machine({Axis::y, Axis::a}, 100, MmPerSecond(266), MmPerSecond2(313));
  std::string program = "G21 G91 F857\n";
  for (int i = 0; i < 30; ++i) program += "G1 Y.0863 A.74\nG1 A1.14\n";
  for (const double tolerance : {0.001, 0.005, 0.02, 0.1}) {
    machine.path_tolerance = Mm(tolerance);
    const test::Ending ending = test::run(program + "M2\n", machine, {.live = {}});
    for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
    EXPECT_LT(ending.proof.times_bound(), 1.012) << "within " << tolerance << " mm";
  }
}

// Lines that are one but for rounding, at feeds that change. They are smoothed into long spans, in each of which the
// motion may speed up and slow down.
TEST(FeedChanges, cost_nothing_on_a_nearly_straight_path) {
  MachineDescription machine = even_machine({Axis::x, Axis::y, Axis::z}, 5, MmPerSecond(115), MmPerSecond2(50));
  machine.path_tolerance = Mm(0.001);
  std::string program = "G21 G90\n";
  const std::vector<std::pair<double, double>> lines = {{1, 13'000}, {18, 420},  {24, 420},
                                                        {25, 1950},  {26, 7800}, {30, 7800}};
  for (const auto& [parts, feed] : lines) {
    program +=
        fmt::format("G1 X{:.6f} Y{:.6f} Z{:.6f} F{}\n", 0.1301019 * parts, -0.0136874 * parts, 0.4869851 * parts, feed);
  }
  const test::Ending ending = test::run(program + "M2\n", machine, {.live = {}});
  for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
  EXPECT_LT(ending.proof.times_bound(), 1.005);
}

// An override may make it faster than the program says, and nothing else.
void expect_right_in_spite_of_acts(const test::RandomJob& job, test::Random& random, test::Acts& acts) {
  test::Meddling meddling{.random = random, .acts = acts, .highest_override = 2};
  const test::Ending ending = test::run(job.program, job.machine, {.meddling = &meddling});
  for (const std::string& fault : ending.proof.faults()) {
    if (!fault.starts_with("feed")) ADD_FAILURE() << fault;
  }
  expect_end(ending, job.machine);
}

TEST(RandomMotion, keeps_limits_and_path_in_spite_of_holds_and_overrides) {
  test::Acts acts;
  test::for_each_job(100, [&](std::uint64_t, const test::RandomJob& job, test::Random& random) {
    expect_right_in_spite_of_acts(job, random, acts);
  });
  acts.print();
}

// A very slow feed with limits of jerk; dust of a rotary axis; an override lowered where the torque leaves no choice.
TEST(RandomMotion, keeps_them_in_programs_that_once_failed) {
  for (const std::uint64_t number : {1544U, 1673U, 900310U}) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(number));
    test::Random random = test::Random::of(number);
    const test::RandomJob job(random);
    test::Acts acts;
    expect_right_in_spite_of_acts(job, random, acts);
  }
}

}  // namespace
}  // namespace passo
