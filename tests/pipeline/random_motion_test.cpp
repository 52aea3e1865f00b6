// Random programs on random machines, from text to steps, each measured by the referee: no limit exceeded on any axis,
// no place off the path, the steps those of the motion, the end where the program says, and not slower than it must be.
//
// PASSO_SEED=S PASSO_RUNS=N random_motion_tests takes the programs S to S + N - 1. Each depends on its number alone.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "kit/list_source.hpp"
#include "kit/meddled_run.hpp"
#include "kit/random_gcode.hpp"

#include "passo/proof/proof_text.hpp"

namespace passo {
namespace {

// No motion is faster than the bound, but for what the digits of a long job leave.
constexpr double rounding = 1e-6;

// The prover's allowance for rounding.
constexpr double most_of_limit = 1.0001;

// Without limits of jerk: the worst of 3,000 programs took 1.0097 times the bound.
constexpr double most_of_bound = 1.015;

// What one kind of programs gave, of those of more than a second: a quotient of times, or seconds.
class Spread {
 public:
  void add(double value, std::uint64_t number) {
    if (all_.empty() || value > worst_) {
      worst_ = value;
      worst_number_ = number;
    }
    all_.push_back(value);
  }
  void print(const char* name) {
    if (all_.empty()) return;
    std::ranges::sort(all_);
    std::printf("%s: %zu programs, least %.6f, median %.4f, 95 %% %.4f, 99 %% %.4f, worst %.4f (%llu)\n", name,
                all_.size(), all_.front(), at(0.5), at(0.95), at(0.99), worst_,
                static_cast<unsigned long long>(worst_number_));
  }

 private:
  double at(double share) const { return all_[static_cast<std::size_t>(share * static_cast<double>(all_.size() - 1))]; }
  std::vector<double> all_;
  double worst_ = 0;
  std::uint64_t worst_number_ = 0;
};

// Every program is shorter than the thousand lines that have to be planned in this time. It is reported only.
constexpr double allowed_seconds = 5;

void expect_end(const test::Ending& ending, const MachineDescription& machine) {
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const double place = ending.place[machine.axes[m].axis] * machine.axes[m].steps_per_unit;
    EXPECT_NEAR(static_cast<double>(ending.motors[m].position), place, 0.5 + 1e-6) << "motor " << m;
  }
}

void expect_nearly_the_fastest(test::Machines machines) {
  Spread along_path[2];
  Spread in_tube[2];
  Spread effort;
  std::uint64_t moves = 0;
  double seconds = 0;
  int too_long = 0;
  const auto try_one = [&](std::uint64_t number, const test::RandomJob& job, test::Random&) {
    const std::clock_t begin = std::clock();
    const test::Ending ending = test::run(job.program, job.machine, {.live = endless_commitment});
    effort.add(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, number);
    if (static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC > allowed_seconds) ++too_long;
    const MotionProof& proof = ending.proof;
    for (const std::string& fault : proof.faults()) ADD_FAILURE() << fault;
    expect_end(ending, job.machine);
    EXPECT_GE(proof.time.value(), proof.time_bound.value() * (1 - rounding));
    EXPECT_GE(proof.time.value(), proof.tube_bound.value() * (1 - rounding));
    const bool with_jerk = has_jerk_limit(job.machine);
    // The bound does not know that an axis which turns back shares its start-stop velocity between the two ways.
    const bool is_tight = machines == test::Machines::as_drawn || machines == test::Machines::mixed;
    if (!with_jerk && is_tight) {
      EXPECT_LE(proof.time.value(), proof.time_bound.value() * most_of_bound);
    }
    if (test::number_of("PASSO_RUNS", 0) == 1) std::printf("%s", to_text(proof).c_str());
    if (proof.time > Seconds(1)) {
      along_path[with_jerk ? 1 : 0].add(proof.times_bound(), number);
      in_tube[with_jerk ? 1 : 0].add(proof.times_tube_bound(), number);
    }
    moves += proof.moves;
    seconds += proof.time.value();
  };
  test::for_each_job(test::fewer(100, 4), try_one, machines);
  std::printf("%llu moves, %.0f s of motion; of more than a second:\n", static_cast<unsigned long long>(moves),
              seconds);
  along_path[0].print("acceleration limited, T/bound on the path");
  along_path[1].print("jerk limited, T/bound on the path");
  in_tube[0].print("acceleration limited, T/bound in the tube");
  in_tube[1].print("jerk limited, T/bound in the tube");
  effort.print("seconds of the processor, proof included");
  std::printf("%d of them took more than %.0f s of the processor\n", too_long, allowed_seconds);
}

TEST(RandomMotion, keeps_limits_and_path_and_is_nearly_the_fastest) {
  expect_nearly_the_fastest(test::Machines::as_drawn);
}

// A third of the machines have limits of jerk on some of their axes, and more than a third have a rotary axis.
TEST(RandomMotion, is_nearly_the_fastest_with_limits_of_jerk_on_some_axes) {
  expect_nearly_the_fastest(test::Machines::mixed);
}

TEST(RandomMotion, keeps_limits_and_path_with_start_stop_velocities) {
  expect_nearly_the_fastest(test::Machines::starting);
}

// Backlash, jerk limits, torque curves and start-stop velocities on any of the axes, and lines in which a rotary axis
// does most.
TEST(RandomMotion, keeps_limits_and_path_on_machines_of_all_mixtures) {
  expect_nearly_the_fastest(test::Machines::of_any_limits);
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
    const test::Ending ending = test::run(program + "M2\n", machine, {.live = endless_commitment});
    for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
    EXPECT_LT(ending.proof.times_bound(), 1.012) << "within " << tolerance << " mm";
  }
}

// Stairs whose second legs are arcs of 50 mm, nearly lines, take no longer than stairs of lines. Corners beside arcs
// were rounded inside alone: 1.02 and 1.06 times that time.
TEST(ArcCorners, are_passed_as_fast_as_corners_between_lines) {
  for (const MmPerSecond3 jerk : {MmPerSecond3(0), MmPerSecond3(25'000)}) {
    MachineDescription machine = even_machine({Axis::x, Axis::y}, 400, MmPerSecond(100), MmPerSecond2(500));
    machine.path_tolerance = Mm(0.01);
    for (AxisDescription& axis : machine.axes) axis.jerk = jerk;
    const auto time_of_stairs = [&](const char* leg) {
      std::string program = "G21 G90 G17 F60000\n";
      for (int i = 1; i <= 6; ++i)
        program +=
            fmt::format("G1 X{}\n{} X{} Y{}{}\n", 5 * i, leg, 5 * i, 5 * i, leg == std::string("G2") ? " R50" : "");
      const test::Ending ending = test::run(program + "M2\n", machine, {.live = endless_commitment});
      for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
      return ending.proof.time.value();
    };
    EXPECT_LT(time_of_stairs("G2"), 1.003 * time_of_stairs("G1"));
  }
}

// On a short arc from rest to rest the slow axis alone decides, and its slope halves on the way.
TEST(UnevenAxes, play_a_short_arc_nearly_as_fast_as_can_be) {
  MachineDescription machine = even_machine({Axis::x, Axis::y}, 50, MmPerSecond(200), MmPerSecond2(130));
  machine.axes[0].acceleration = MmPerSecond2(32);
  const std::string program = "G21 G90 F30000\nG2 X-0.012965 Y0.027477 I0.084315 J0.056581\nM2\n";
  const test::Ending ending = test::run(program, machine, {.live = endless_commitment});
  for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
  EXPECT_LT(ending.proof.times_bound(), 1.01);
}

// Chords of a wide bend, where X has a fifth of the acceleration of Y.
TEST(UnevenAxes, follow_chords_nearly_as_fast_as_can_be) {
  test::Random random = test::Random::of(811503309);
  const test::RandomJob job(random);
  const test::Ending ending = test::run(job.program, job.machine, {.live = endless_commitment});
  for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
  EXPECT_LT(ending.proof.times_bound(), 1.012);
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
  const test::Ending ending = test::run(program + "M2\n", machine, {.live = endless_commitment});
  for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
  EXPECT_LT(ending.proof.times_bound(), 1.005);
}

// Chords with tight corners and a spline with a narrow bend, where jerk decides. The bound knew nothing of jerk in
// bends: the motion took 1.68 and 1.85 times the bound.
TEST(RandomMotion, is_nearly_the_fastest_where_jerk_in_bends_decides) {
  for (const std::uint64_t number : {811503162U, 940716U}) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(number));
    test::Random random = test::Random::of(number);
    const test::RandomJob job(random);
    const test::Ending ending = test::run(job.program, job.machine, {.live = endless_commitment});
    for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
    EXPECT_LT(ending.proof.times_bound(), 1.2);
    EXPECT_GE(ending.proof.times_bound(), 1 - rounding);
  }
}

// A torque that falls to a ninth within 3 mm/s, or within 11. Where that steep line meets the next one, the axis took
// 1.0026 and 1.0008 times what its torque gives: the peak lay between the places looked at.
TEST(RandomMotion, keeps_to_the_torque_where_its_curve_bends) {
  for (const auto& [machines, number] :
       {std::pair{test::Machines::mixed, 904647U}, {test::Machines::as_drawn, 3011470U}}) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(number));
    test::Random random = test::Random::of(number);
    const test::RandomJob job = test::RandomJob::of(machines, number, random);
    const test::Ending ending = test::run(job.program, job.machine, {.live = endless_commitment});
    for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
  }
}

// An override may make it faster than the program says by its factor, and nothing else.
void expect_right_in_spite_of_acts(const test::RandomJob& job, test::Random& random, test::Acts& acts) {
  constexpr double highest_override = 2;
  test::Meddling meddling{.random = random, .acts = acts, .highest_override = highest_override};
  const test::Ending ending = test::run(job.program, job.machine, {.meddling = &meddling});
  for (const std::string& fault : ending.proof.faults()) {
    if (!fault.starts_with("feed")) ADD_FAILURE() << fault;
  }
  EXPECT_LE(ending.proof.feed.multiple(), highest_override * most_of_limit);
  expect_end(ending, job.machine);
}

TEST(RandomMotion, keeps_limits_and_path_in_spite_of_holds_and_overrides) {
  test::Acts acts;
  test::for_each_job(test::fewer(100, 4), [&](std::uint64_t, const test::RandomJob& job, test::Random& random) {
    expect_right_in_spite_of_acts(job, random, acts);
  });
  acts.print();
}

TEST(RandomMotion, keeps_limits_and_path_in_spite_of_holds_with_start_stop_velocities) {
  test::Acts acts;
  const auto try_one = [&](std::uint64_t, const test::RandomJob& job, test::Random& random) {
    expect_right_in_spite_of_acts(job, random, acts);
  };
  test::for_each_job(test::fewer(60, 4), try_one, test::Machines::starting);
  acts.print();
}

TEST(RandomMotion, keeps_limits_and_path_in_spite_of_holds_on_machines_of_all_mixtures) {
  test::Acts acts;
  const auto try_one = [&](std::uint64_t, const test::RandomJob& job, test::Random& random) {
    expect_right_in_spite_of_acts(job, random, acts);
  };
  test::for_each_job(test::fewer(60, 4), try_one, test::Machines::of_any_limits);
  acts.print();
}

// Vertices up to one and a half times the tolerance off a straight line. They may be merged only so far that the tool
// stays within the tolerance.
TEST(RandomMotion, keeps_the_path_on_nearly_straight_lines) {
  test::Random random = test::Random::of(46);
  for (int trial = 0; trial < 6; ++trial) {
    MachineDescription machine = even_machine({Axis::x, Axis::y}, 400, MmPerSecond(100), MmPerSecond2(500));
    if (trial % 2 == 1) {
      for (AxisDescription& axis : machine.axes) axis.jerk = MmPerSecond3(25'000);
    }
    const double tolerance = std::exp(random.between(-6, -2));
    std::string program = fmt::format("G21 G90 G64 P{:.5f} Q{:.5f} F6000\n", tolerance, 0.8 * tolerance);
    double x = 0;
    for (int i = 0; i < 60; ++i) {
      x += std::exp(random.between(-3, 1));
      program += fmt::format("G1 X{:.5f} Y{:.5f}\n", x, tolerance * random.between(-1.5, 1.5));
    }
    SCOPED_TRACE(program);
    const test::Ending ending = test::run(program + "M2\n", machine, {.live = endless_commitment});
    for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
  }
}

// A line and a tangent arc by turns. The planner gets them as they are: the smoother would leave no jump of the bend.
std::vector<PathItem> tangent_arcs(test::Random& random) {
  std::vector<PathItem> path;
  Point at;
  double direction = random.between(0, 6);
  for (int i = 0; i < 12; ++i) {
    const double length = random.between(0.5, 5);
    const double turn = i % 2 == 0 ? 0 : random.between(0.5, 2) * (random.chance(0.5) ? 1 : -1);
    Segment segment;
    segment.speed = MmPerSecond(100);
    segment.tolerance = Mm(0.01);
    Point end = at;
    if (turn == 0) {
      end[Axis::x] += length * std::cos(direction);
      end[Axis::y] += length * std::sin(direction);
      segment.curve = Curve::line(at, end);
    } else {
      const double radius = length / turn;
      const double center_x = at[Axis::x] - radius * std::sin(direction);
      const double center_y = at[Axis::y] + radius * std::cos(direction);
      end[Axis::x] = center_x + radius * std::sin(direction + turn);
      end[Axis::y] = center_y - radius * std::cos(direction + turn);
      segment.curve = Curve::arc(at, end, Axis::x, Axis::y, center_x, center_y, turn);
    }
    segment.source.line = static_cast<std::uint32_t>(i + 1);
    path.emplace_back(segment);
    at = end;
    direction += turn;
  }
  return path;
}

// With jerk limits the acceleration does not jump where the bend of the path does.
TEST(RandomMotion, passes_jumps_of_the_bend_without_a_jump_of_the_acceleration) {
  test::Random random = test::Random::of(46);
  for (int trial = 0; trial < 6; ++trial) {
    MachineDescription machine = even_machine({Axis::x, Axis::y}, 400, MmPerSecond(100), MmPerSecond2(500));
    for (AxisDescription& axis : machine.axes)
      axis.jerk = axis.acceleration / Seconds(std::exp(random.between(-5, -2)));
    const std::vector<PathItem> path = tangent_arcs(random);
    test::ListSource<PathItem> source(path);
    Planner planner(source, motion_limits(machine));
    MotionProver prover(proof_options(machine));
    for (const PathItem& item : path) prover.watch(item);
    for (MotionItem item; planner.next(item);) prover.watch(item);
    const MotionProof proof = prover.finish();
    for (const std::string& fault : proof.faults()) ADD_FAILURE() << "trial " << trial << ": " << fault;
    EXPECT_GT(proof.time, Seconds(0.5));
  }
}

// A hold in a corner in which the torque of an axis left, but for rounding, one speed at the end of a cell: the machine
// stopped at once, with 30 times its acceleration. And a hold just before the end of a cell in which the motion was
// ahead of its plan: it braked with 1.2 times its acceleration, to catch up.
TEST(RandomMotion, brakes_within_limits_at_the_end_of_a_cell) {
  test::Acts acts;
  for (const auto& [machines, number] : {std::pair{test::Machines::as_drawn, 1129000694U},
                                         {test::Machines::starting, 1129000554U},
                                         {test::Machines::starting, 1129001167U}}) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(number));
    test::Random random = test::Random::of(number);
    const test::RandomJob job = test::RandomJob::of(machines, number, random);
    expect_right_in_spite_of_acts(job, random, acts);
  }
}

// Only the mode of the lines says that the machine stops between them.
TEST(RandomMotion, stops_exactly_on_a_straight_line) {
  for (const MmPerSecond3 jerk : {MmPerSecond3(0), MmPerSecond3(25'000)}) {
    MachineDescription machine = even_machine({Axis::x, Axis::y}, 400, MmPerSecond(100), MmPerSecond2(500));
    for (AxisDescription& axis : machine.axes) axis.jerk = jerk;
    const test::Ending ending =
        test::run("G21 G90 G61.1\nG1 X3 Y1 F6000\nG1 X6 Y2\nG1 X9 Y3\nM2\n", machine, {.live = endless_commitment});
    for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
    EXPECT_NEAR(ending.proof.times_bound(), 1, 1e-3);
  }
}

// The last part of an arc was as short as rounding, and the arc counted twice in the bound.
TEST(RandomMotion, is_not_faster_than_the_bound_where_backlash_cuts_an_arc) {
  test::Random random = test::Random::of(2462);
  const test::RandomJob job = test::RandomJob::of_all_mixtures(2462, random);
  const test::Ending ending = test::run(job.program, job.machine, {.live = endless_commitment});
  for (const std::string& fault : ending.proof.faults()) ADD_FAILURE() << fault;
  EXPECT_GE(ending.proof.times_bound(), 1 - rounding);
}

// A very slow feed with limits of jerk; dust of a rotary axis; an override lowered, and a hold, where the torque leaves
// no choice; a stop taken back in its last instant, where 1e-16 mm/s were left.
TEST(RandomMotion, keeps_them_in_programs_that_once_failed) {
  for (const std::uint64_t number : {1544U, 1673U, 900310U, 1500025U, 811500132U}) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(number));
    test::Random random = test::Random::of(number);
    const test::RandomJob job(random);
    test::Acts acts;
    expect_right_in_spite_of_acts(job, random, acts);
  }
}

}  // namespace
}  // namespace passo
