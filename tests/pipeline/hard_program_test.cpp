// The laws of speed on programs that ask much of the planner: dust, sharp teeth, rotary axes that turn by thousands of
// degrees a millimetre, a new feed on each line. Each is planned on machines with limits of jerk on all axes, on some,
// or on none, and with the torque of motors. The work must be bounded: the number of phases decides. The processor's
// time is printed. That the limits are kept, the random programs show.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "kit/meddled_run.hpp"
#include "kit/random_gcode.hpp"

namespace passo {
namespace {

// PASSO_LINES: how many each program has. PASSO_ONLY: a part of the names of those to plan, as they are printed.
int line_count() {
  return static_cast<int>(test::number_of("PASSO_LINES", 100));
}
bool is_wanted(const std::string& name) {
  const char* const only = std::getenv("PASSO_ONLY");
  return only == nullptr || name.find(only) != std::string::npos;
}

struct Kind {
  const char* name;
  std::function<std::string(int)> line;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"teeth of 0.01 mm", [](int i) { return fmt::format("G1 X{:.4f} Y{:.4f}", 0.01 * i, 0.01 * (i % 2)); }},
      {"needles", [](int i) { return fmt::format("G1 X{:.4f} Y{:.4f}", 0.001 * i, 5.0 * (i % 2)); }},
      {"spiral of chords",
       [](int i) {
         return fmt::format("G1 X{:.5f} Y{:.5f}", 0.002 * i * std::cos(0.2 * i), 0.002 * i * std::sin(0.2 * i));
       }},
      {"tiny arcs and long lines",
       [](int i) {
         const double side = i / 2 % 2 == 0 ? 0.0 : 50.0;
         return i % 2 == 0 ? fmt::format("G1 X{:.4f}", side)
                           : fmt::format("G3 X{:.4f} Y{:.4f} I0 J0.01", side, 0.01 * (i + 1));
       }},
      {"a rotary axis of 40,000 degrees a millimetre",
       [](int i) { return fmt::format("G1 X{:.5f} A{:.4f}", 0.001 * i, 40.0 * (i % 3)); }},
      {"a rotary axis that moves alone on each second line",
       [](int i) {
         return i % 2 == 0 ? fmt::format("G1 X{:.5f} A{:.4f}", 0.001 * i, 40.0 * i)
                           : fmt::format("G1 A{:.4f}", 40.0 * i);
       }},
      {"a new feed on each line",
       [](int i) {
         return fmt::format("G1 X{:.4f} Y{:.4f} F{:.1f}", 0.3 * i, 0.05 * std::sin(0.7 * i),
                            i % 2 == 0 ? 20'000.0 : 2.0 + i);
       }},
      {"creeping",
       [](int i) { return fmt::format("G1 X{:.4f} Y{:.4f} F{:.1f}", 2.0 * (i % 5), 0.3 * i, 1.0 + i % 7); }},
      {"dust of all sizes",
       [](int i) {
         const double size = std::pow(10, -4 + i % 5);
         return fmt::format("G1 X{:.5f} Y{:.5f} Z{:.5f}", size * std::sin(1.7 * i), size * std::cos(2.3 * i),
                            size * std::sin(3.1 * i));
       }},
      {"helices",
       [](int i) { return fmt::format("G2 X0 Y0 I{:.3f} J0 Z{:.4f} P3", 0.01 + 0.02 * (i % 50), 0.01 * i); }},
      {"splines",
       [](int i) {
         return fmt::format("G5 I{:.3f} J{:.3f} P{:.3f} Q{:.3f} X{:.4f} Y{:.4f}", std::sin(1.0 * i), std::cos(2.0 * i),
                            std::sin(3.0 * i), std::cos(4.0 * i), 0.1 * i, std::sin(0.3 * i));
       }},
  };
  return all;
}

struct Limits {
  const char* name;
  double rise;  // seconds, of the acceleration; 0: no limit of jerk
  bool some_only;
  bool torque;
};
constexpr std::array all_limits = {
    Limits{"jerk on no axis", 0, false, false},      Limits{"with torque", 0, false, true},
    Limits{"jerk on all axes", 0.02, false, false},  Limits{"soft on all axes", 0.15, false, false},
    Limits{"hard on all axes", 0.001, false, false}, Limits{"jerk on some axes", 0.02, true, false},
    Limits{"jerk and torque", 0.02, true, true}};

MachineDescription machine_with(const Limits& limits) {
  test::Random random = test::Random::of(1);
  MachineDescription machine;
  machine.name = limits.name;
  machine.path_tolerance = Mm(0.01);
  machine.board.highest_event_rate = Hertz(1e6);
  for (const Axis axis : {Axis::x, Axis::y, Axis::z, Axis::a}) {
    AxisDescription own;
    own.axis = axis;
    own.steps_per_unit = 20;
    own.velocity = MmPerSecond(axis == Axis::a ? 3000 : 200);
    own.acceleration = MmPerSecond2(axis == Axis::a ? 20'000 : 1500);
    if (limits.rise > 0 && (!limits.some_only || axis == Axis::x || axis == Axis::a)) {
      own.jerk = MmPerSecond3(own.acceleration.value() / limits.rise);
    }
    own.travel_low = -1e5;
    own.travel_high = 1e5;
    if (limits.torque) own.motor = test::random_motor(random, own);
    machine.axes.push_back(own);
  }
  return machine;
}

struct Planned {
  double seconds = 0;  // of the processor, from text to phases
  double time = 0;     // of the motion
  std::size_t phases = 0;
  std::size_t rests = 0;  // phases that begin at rest, but for the first
};

Planned plan(const std::string& program, const MachineDescription& machine, Smoothness smooth) {
  const std::clock_t begin = std::clock();
  Diagnostics diagnostics;
  Interpreter interpreter(ProgramReader::from_text("t", program), InterpreterOptions(), diagnostics);
  const PathOptions options = path_options(machine, "t");
  PathBuilder builder(interpreter, options, diagnostics);
  PathSmoother smoother(builder, smooth);
  Planner planner(smoother, motion_limits(machine));
  Planned planned;
  for (MotionItem item; planner.next(item);) {
    const auto* const move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) continue;
    const bool is_first = planned.phases == 0;
    planned.phases += move->phase_count;
    planned.rests +=
        static_cast<std::size_t>(std::count_if(move->begin() + (is_first ? 1 : 0), move->end(),
                                               [](const Phase& phase) { return !(phase.velocity.value() > 0); }));
    planned.time += move->duration().value();
  }
  planned.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  return planned;
}

std::string program_of(const Kind& kind) {
  std::string program = "G21 G90 G17 G64 P0.005 F6000\n";
  for (int i = 1; i <= line_count(); ++i) program += kind.line(i) + "\n";
  return program + "M2\n";
}

// Of a line of the program. A plan that looks at ever finer cells has more.
constexpr std::size_t most_phases = 1600;

TEST(HardPrograms, are_planned_in_a_bounded_number_of_phases) {
  for (const Kind& kind : kinds()) {
    const std::string program = program_of(kind);
    for (const Limits& limits : all_limits) {
      const std::string name = fmt::format("{}, {}", kind.name, limits.name);
      if (!is_wanted(name)) continue;
      SCOPED_TRACE(name);
      const MachineDescription machine = machine_with(limits);
      const Planned planned = plan(program, machine, smoothness(machine));
      EXPECT_GT(planned.phases, 0U);
      EXPECT_LE(planned.phases, most_phases * static_cast<std::size_t>(line_count()));
      std::printf("%6.2f s of the processor, %9.1f s of motion, %8zu phases: %s\n", planned.seconds, planned.time,
                  planned.phases, name.c_str());
      std::fflush(stdout);
    }
  }
}

// A machine of four axes with any mixture of limits.
MachineDescription mixed_machine(test::Random& random) {
  MachineDescription machine;
  machine.name = "mixed";
  machine.path_tolerance = Mm(std::exp(random.between(-7, -2)));
  machine.board.highest_event_rate = Hertz(1e6);
  const double velocity = std::exp(random.between(3, 6));
  const double acceleration = std::exp(random.between(4.5, 9));
  const double rise = std::exp(random.between(-7, -1.5));
  enum class Jerk : std::uint8_t { none, all, some, uneven };
  const auto jerk = static_cast<Jerk>(random.between(0, 3.999));
  const bool torque = random.chance(0.5);
  const auto part = [&] { return random.chance(0.5) ? 1 : random.between(0.2, 1); };
  for (const Axis axis : {Axis::x, Axis::y, Axis::z, Axis::a}) {
    AxisDescription own;
    own.axis = axis;
    own.steps_per_unit = 20;
    const double turns = axis == Axis::a ? std::exp(random.between(-1, 4)) : 1;
    own.velocity = MmPerSecond(std::min(4e4, velocity * turns * part()));
    own.acceleration = MmPerSecond2(acceleration * turns * part());
    const bool limited = jerk != Jerk::none && (jerk != Jerk::some || random.chance(0.5));
    const double slower = limited && jerk == Jerk::uneven ? std::exp(random.between(0, 2)) : 1;
    if (limited) own.jerk = MmPerSecond3(own.acceleration.value() / rise / slower);
    own.travel_low = -1e7;
    own.travel_high = 1e7;
    if (torque) own.motor = test::random_motor(random, own);
    machine.axes.push_back(own);
  }
  return machine;
}

// One, two or three sorts of lines by turns. In each sort every axis stands, goes on, swings, jumps to and fro or goes
// anywhere, by micrometres or by centimetres.
std::string mixed_program(test::Random& random) {
  struct Sort {
    std::array<double, 4> size{};
    std::array<double, 4> swing{};
    std::array<int, 4> way{};
    bool is_arc = false;
    bool has_feed = false;
    double feed = 0;
  };
  std::string program = random.chance(0.5) ? "G21 G90 G17 G64 F6000\n" : "G21 G90 G17 G64 P0.005 F6000\n";
  std::vector<Sort> sorts(static_cast<std::size_t>(random.between(1, 3.999)));
  for (Sort& sort : sorts) {
    for (std::size_t k = 0; k < 4; ++k) {
      sort.size[k] = random.chance(0.45) ? 0 : std::exp(random.between(-9, k == 3 ? 5 : 3));
      sort.swing[k] = random.between(0.1, 3.1);
      sort.way[k] = static_cast<int>(random.between(0, 3.999));
    }
    sort.is_arc = random.chance(0.15);
    sort.has_feed = random.chance(0.2);
    sort.feed = std::exp(random.between(1, 10));
  }
  std::array<double, 4> at{};
  for (int i = 1; i <= line_count(); ++i) {
    const Sort& sort = sorts[static_cast<std::size_t>(i) % sorts.size()];
    if (sort.is_arc) {
      const double radius = std::max(0.002, sort.size[0]);
      at[0] += 2 * radius;
      program += fmt::format("G2 X{:.5f} Y{:.5f} I{:.5f} J0\n", at[0], at[1], radius);
      continue;
    }
    std::string line;
    for (std::size_t k = 0; k < 4; ++k) {
      if (sort.size[k] == 0) continue;
      const std::array<double, 3> ways = {1, std::sin(sort.swing[k] * i), i % 2 == 0 ? -1.0 : 1.0};
      at[k] += sort.size[k] * (sort.way[k] < 3 ? ways[static_cast<std::size_t>(sort.way[k])] : random.between(-1, 1));
      line += fmt::format(" {}{:.5f}", "XYZA"[k], at[k]);
    }
    if (line.empty()) continue;
    program += "G1" + line + (sort.has_feed ? fmt::format(" F{:.2f}\n", sort.feed / (i % 2 == 0 ? 7 : 1)) : "\n");
  }
  return program + "M2\n";
}

// PASSO_SEED=S PASSO_RUNS=N hunts for programs that take long to plan.
TEST(HardPrograms, of_any_mixture_are_planned_in_a_bounded_number_of_phases) {
  const std::uint64_t first = test::first_seed(1);
  const std::uint64_t runs = test::number_of("PASSO_RUNS", 2);
  for (std::uint64_t number = first; number < first + runs; ++number) {
    SCOPED_TRACE(test::command_again(number, "PASSO_RUNS=1"));
    test::Random random = test::Random::of(number);
    const MachineDescription machine = mixed_machine(random);
    const Planned planned = plan(mixed_program(random), machine, smoothness(machine));
    EXPECT_LE(planned.phases, most_phases * static_cast<std::size_t>(line_count()));
    std::printf("%6.2f s of the processor, %9.1f s of motion, %8zu phases: number %llu\n", planned.seconds,
                planned.time, planned.phases, static_cast<unsigned long long>(number));
  }
}

// At a creeping feed the limits of jerk matter only where the speed changes, for a moment. Where a speed exceeded its
// cap by rounding, the cap was lowered so far that its neighbours exceeded theirs. That took six times as long to plan,
// and the motion took up to 0.3 % more time. The path is the same for both: the feed holds along the tool's own path,
// and each law has its own.
TEST(HardPrograms, creep_as_fast_with_limits_of_jerk) {
  const auto creeping = std::ranges::find(kinds(), std::string("creeping"), &Kind::name);
  ASSERT_NE(creeping, kinds().end());
  const MachineDescription without = machine_with(all_limits[0]);
  for (const Limits& limits : all_limits) {
    const MachineDescription machine = machine_with(limits);
    const Planned fastest = plan(program_of(*creeping), without, smoothness(machine));
    const Planned planned = plan(program_of(*creeping), machine, smoothness(machine));
    EXPECT_LT(planned.time, fastest.time * 1.0003) << limits.name;
  }
}

// A rotary axis without a limit of jerk turns alone on each second line. Through such a corner the speed along the path
// doubled within one cell, and no share of the limits was right for that cell. So the whole window was slowed: 2.0
// times the time without limits of jerk, on a machine whose only limited axis stands.
TEST(HardPrograms, are_planned_in_finer_cells_where_the_speed_changes_at_once) {
  MachineDescription machine;
  machine.name = "one limited axis";
  machine.path_tolerance = Mm(0.03);
  machine.board.highest_event_rate = Hertz(1e6);
  for (const Axis axis : {Axis::x, Axis::y, Axis::z, Axis::a}) {
    AxisDescription own;
    own.axis = axis;
    own.steps_per_unit = 20;
    own.velocity = MmPerSecond(axis == Axis::a ? 36.73 : 50);
    own.acceleration = MmPerSecond2(axis == Axis::a ? 81.0 : 167.7);
    if (axis == Axis::y) own.jerk = MmPerSecond3(70'590);
    own.travel_low = -1e5;
    own.travel_high = 1e5;
    machine.axes.push_back(own);
  }
  const std::string program =
      "G21 G90 G17 G64 F6000\n"
      "G1 X0.24882 Z0.13978\nG1 X0.25001 A3.56978\nG1 X0.16966 Z0.27956\nG1 X0.17119 A7.13956\n"
      "G1 X0.65200 Z0.41934\nG1 X0.65276 A10.70933\nG1 X3.08933 Z0.55912\nG1 X3.08878 A14.27911\n"
      "G1 X2.35266 Z0.69890\nG1 X2.35119 A17.84889\nM2\n";
  MachineDescription without = machine;
  for (AxisDescription& axis : without.axes) axis.jerk = MmPerSecond3(0);
  EXPECT_LT(plan(program, machine, Smoothness::slow_bending).time,
            1.1 * plan(program, without, Smoothness::slow_bending).time);
}

// A rotary axis turns to and fro between tiny arcs. Each window has hundreds of such corners, and none of the program's
// first windows was lifted in 40 steps: the motion came to rest in the middle of the path.
TEST(HardPrograms, go_on_through_many_slow_corners) {
  for (const std::uint64_t number : {700079U, 700119U}) {
    test::Random random = test::Random::of(number);
    const MachineDescription machine = mixed_machine(random);
    EXPECT_EQ(plan(mixed_program(random), machine, smoothness(machine)).rests, 0U) << number;
  }
}

// X has four times the acceleration of Y, and hardly moves. Cells were so fine as if X drove the path: 2,530 phases a
// line.
TEST(HardPrograms, need_no_finer_cells_for_a_strong_axis_that_hardly_moves) {
  test::Random random = test::Random::of(4329);
  const MachineDescription machine = mixed_machine(random);
  const Planned planned = plan(mixed_program(random), machine, smoothness(machine));
  EXPECT_LE(planned.phases, 1000 * static_cast<std::size_t>(line_count()));
}

// A creeping feed, and a limit of jerk on an axis that stands: the ramps take microseconds, and each had 128 cells.
// That took 2,900 phases a line, and a little more time.
TEST(HardPrograms, need_few_cells_for_ramps_of_microseconds) {
  for (const std::uint64_t number : {5047U, 5139U}) {
    test::Random random = test::Random::of(number);
    const MachineDescription machine = mixed_machine(random);
    const Planned planned = plan(mixed_program(random), machine, smoothness(machine));
    EXPECT_LE(planned.phases, 500 * static_cast<std::size_t>(line_count())) << number;
  }
}

// A motion within jerk limits is also allowed without them. So on the same path no machine is slower without them,
// except for its cells: they have an even acceleration and a velocity limit each, and a wide corner has 24 of them,
// where the jerk law has hundreds of phases. In number 99183 (mixed) this costs 0.44 %. On the path that is smoothed
// for it, none of 885 machines took more than 1.0121 times as long (numbers from 50000, 61000 and 72000 on). Few do:
// number 551247 (as drawn) takes 1.083 times as long, because its own path, which does not swing wide where an axis
// reverses, takes 1.11 times as long as the other.
TEST(LawsOfSpeed, are_never_slower_without_limits_of_jerk) {
  constexpr double rarely_more = 1.013;
  int compared = 0;
  int above = 0;
  double worst = 0;
  const auto compare = [&](std::uint64_t, const test::RandomJob& job, test::Random&) {
    if (!has_jerk_limit(job.machine)) return;
    MachineDescription without = job.machine;
    for (AxisDescription& axis : without.axes) axis.jerk = MmPerSecond3(0);
    const Planned slow = plan(job.program, job.machine, Smoothness::slow_bending);
    const Planned fast = plan(job.program, without, Smoothness::slow_bending);
    EXPECT_LE(fast.time, slow.time * 1.005);
    const double own = plan(job.program, without, smoothness(without)).time;
    EXPECT_LE(own, slow.time * 1.1);
    if (slow.time > 0) worst = std::max(worst, own / slow.time);
    if (own > slow.time * rarely_more) ++above;
    ++compared;
  };
  test::for_each_job(test::fewer(200, 4), compare);
  test::for_each_job(test::fewer(200, 4), compare, test::Machines::mixed);
  EXPECT_LE(above, std::max(1, compared / 50)) << "more than " << rarely_more << " times as long";
  std::printf("%d machines compared, at worst %.4f times as long without limits of jerk\n", compared, worst);
}

// The tolerance is ten lines wide, and inverse time asks for a slow feed. The path cuts all corners off. The feed held
// along the programmed path then, so that the tool was slower than that: 1.10 times the time with limits of jerk, where
// the feed held along the tool's path.
TEST(LawsOfSpeed, hold_the_feed_where_the_path_cuts_corners) {
  test::Random random = test::Random::of(51042);
  const test::RandomJob job(random);
  ASSERT_TRUE(has_jerk_limit(job.machine));
  MachineDescription without = job.machine;
  for (AxisDescription& axis : without.axes) axis.jerk = MmPerSecond3(0);
  EXPECT_LT(plan(job.program, without, smoothness(without)).time,
            plan(job.program, job.machine, smoothness(job.machine)).time);
}

}  // namespace
}  // namespace passo
