// Probing: a move stops on contact, the place of contact is known to the step, and the program goes on from where the
// machine rests.
#include <cmath>
#include <string>
#include <vector>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/stage_test.hpp"
#include "pipeline/probe_kit.hpp"

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

using test::below;
using test::ContactOracle;
using test::example_machine;

struct Probed {
  std::vector<ProbeOutcome> outcomes;
  std::vector<Point> contacts;  // as the oracle saw them
  Point end;                    // by the steps of the motors
  Diagnostics diagnostics;
  bool stopped_by_probe = false;
  BoardOutputs outputs;
  SavedParameters parameters;
  ToolTable tools;
};

// `random`: meddles with holds and overrides.
Probed run(const std::string& program, const MachineDescription& machine, const TouchBox& box,
           test::Random* random = nullptr, const InterpreterOptions& options = {}) {
  Probed result;
  IdealPlant plant = plant_of(machine, options.start, {box});
  test::DrivenProgram job(ProgramReader::from_text("t", program), machine, options, result.diagnostics,
                          {.plant = &plant, .live = random != nullptr ? live_commitment : endless_commitment});
  ContactOracle oracle(machine, box);
  job.machine().add_observer(oracle);
  MotionDrive& drive = job.drive();
  drive.probe().watch([&](const ProbeOutcome& outcome) { result.outcomes.push_back(outcome); });
  while (job.advance()) {
    if (random == nullptr) continue;
    if (drive.state() == MotionDrive::State::running && random->chance(0.01)) drive.hold();
    if (drive.state() == MotionDrive::State::holding && random->chance(0.05)) drive.resume();
    if (drive.state() == MotionDrive::State::held) drive.resume();
    if (random->chance(0.02)) drive.set_feed_override(random->between(0.1, 2));
  }
  EXPECT_FALSE(job.link().error());
  result.contacts = oracle.contacts;
  result.stopped_by_probe = drive.stopped_by_probe();
  const MachineCounts counts = job.machine().counts();
  result.outputs = counts.outputs;
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    const auto steps = static_cast<double>(counts.motors[m].position);
    result.end[axis.axis] = (axis.inverted ? -steps : steps) / axis.steps_per_unit;
  }
  result.parameters = job.program().saved_parameters();
  result.tools = job.program().tools();
  return result;
}

void expect_step_near(const MachineDescription& machine, const Point& place, const Point& expected) {
  for (const AxisDescription& axis : machine.axes) {
    EXPECT_NEAR(place[axis.axis], expected[axis.axis], 0.5 / axis.steps_per_unit + 1e-9) << letter_of(axis.axis);
  }
}

std::string words(const Point& place) {
  return "X" + std::to_string(place[Axis::x]) + " Y" + std::to_string(place[Axis::y]) + " Z" +
         std::to_string(place[Axis::z]);
}

constexpr const char* probed_machines[] = {"bench", "router", "pantograph", "forty-eight", "strong-router"};

// Of a probe move: how far it may go on after the contact, as docs/manual/probing.md promises.
double longest_overrun(const MachineDescription& machine, double speed) {
  double overrun = 0;
  for (const AxisDescription& axis : machine.axes) {
    const double slowest = axis.acceleration_at(axis.velocity).value();
    overrun = std::max(overrun, speed * 0.007 + speed * speed / (2 * slowest) + 2 / axis.steps_per_unit);
  }
  return overrun;
}

void expect_exact_contacts(bool meddled) {
  test::Random random;
  double most = 0;
  int trials = 0;
  for (const char* name : probed_machines) {
    SCOPED_TRACE(name);
    const MachineDescription machine = example_machine(name);
    for (int i = 0; i < (meddled ? 5 : 10) && !testing::Test::HasFailure(); ++i, ++trials) {
      const Axis axis = random.chance(0.4) ? Axis::z : random.chance(0.5) ? Axis::x : Axis::y;
      const TouchBox box = below(axis, random.between(-4, -0.5));
      Point start = test::xyz(random.between(-5, 5), random.between(-5, 5), random.between(-5, 5));
      start[axis] = random.between(0, 3);
      Point end = start + test::xyz(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3));
      end[axis] = random.between(-7, -4.5);
      const double speed = random.between(0.5, 8);
      const std::string program = "G21 G90 G0 " + words(start) + "\nF" + std::to_string(speed * 60) + " G38.2 " +
                                  words(end) + "\n#31=#5070\nG1 " + words(start) + "\nG0 X0 Y0 Z0\nM2\n";
      const Probed result = run(program, machine, box, meddled ? &random : nullptr);
      ASSERT_FALSE(result.diagnostics.any_error()) << render(result.diagnostics, false);
      ASSERT_EQ(result.outcomes.size(), 1U);
      const ProbeOutcome& outcome = result.outcomes[0];
      EXPECT_TRUE(outcome.touched);
      ASSERT_GE(result.contacts.size(), 1U);
      for (const AxisDescription& each : machine.axes) {
        const bool moved =
            std::abs(outcome.contact[each.axis] - start[each.axis]) > 1e-6;  // as it is written in the program
        const double tolerance = moved ? 1e-9 : 0.5 / each.steps_per_unit + 1e-9;
        EXPECT_NEAR(outcome.contact[each.axis], result.contacts[0][each.axis], tolerance) << letter_of(each.axis);
      }
      const double overrun = distance(outcome.rest, outcome.contact);
      EXPECT_LE(overrun, longest_overrun(machine, meddled ? 2 * speed : speed)) << "at " << speed << " mm/s";
      most = std::max(most, overrun);
      expect_step_near(machine, result.end, Point());
    }
  }
  std::printf("%d probe moves, at most %.3f mm from contact to rest\n", trials, most);
}

TEST(Probing, finds_the_place_of_contact_to_the_step_and_goes_on_from_where_it_rests) {
  expect_exact_contacts(false);
}

TEST(Probing, with_holds_and_overrides_at_random_instants_loses_nothing) {
  expect_exact_contacts(true);
}

TEST(Probing, stops_while_the_program_is_read_no_further_than_the_probe_move) {
  const MachineDescription router = example_machine("router");
  // The last line depends on what was found: it must not have been interpreted before.
  const Probed result = run("G21 G90 F300\nG38.2 Z-20\nG0 Z5\nG1 X[#5063] F600\nM2\n", router, below(Axis::z, -2.5));
  EXPECT_DOUBLE_EQ(result.end[Axis::x], -2.5);
  EXPECT_DOUBLE_EQ(result.end[Axis::z], 5);
}

TEST(Probing, keeps_the_result_in_work_coordinates_and_units_of_the_program) {
  const MachineDescription router = example_machine("router");
  InterpreterOptions options;
  options.parameters[5061] = options.parameters[5063] = options.parameters[5070] = 0;
  const Probed result = run("G20 G90 F10\nG10 L2 P1 X1 Z-0.5\nG38.2 X-1 Z-1\nM2\n", router,
                            below(Axis::z, -25.4 * 0.75), nullptr, options);
  ASSERT_EQ(result.outcomes.size(), 1U);
  EXPECT_NEAR(result.parameters.at(5063), -0.25, 1.0 / 640 / 25.4);
  EXPECT_NEAR(result.parameters.at(5061), result.outcomes[0].contact[Axis::x] / 25.4 - 1, 1e-12);
  EXPECT_EQ(result.parameters.at(5070), 1);
}

TEST(Probing, without_contact_ends_the_program_or_goes_on) {
  const MachineDescription router = example_machine("router");
  const Probed must = run("G21 G90 S1000 M3 F600\nG38.2 Z-3\nG0 X20\nM2\n", router, below(Axis::z, -9));
  ASSERT_EQ(must.diagnostics.errors(), 1U);
  EXPECT_EQ(must.diagnostics.all()[0].code, "gcode.probe-untouched");
  EXPECT_EQ(must.diagnostics.all()[0].place.line, 2U);
  EXPECT_EQ(must.end, test::xyz(0, 0, -3));
  EXPECT_EQ(must.outputs.switches, 0) << "everything is off";

  const Probed may = run("G21 G90 F600\nG38.3 Z-3\nG0 X[20+#5070]\nM2\n", router, below(Axis::z, -9));
  EXPECT_FALSE(may.diagnostics.any_error());
  EXPECT_EQ(may.end, test::xyz(20, 0, -3));
}

TEST(Probing, away_waits_until_the_probe_is_free) {
  const MachineDescription router = example_machine("router");
  const Probed result = run("G21 G90 F300\nG38.2 Z-5\nG38.4 Z0\nG38.5 Z10\nM2\n", router, below(Axis::z, -2));
  // The third begins with a free probe.
  ASSERT_EQ(result.outcomes.size(), 3U);
  EXPECT_DOUBLE_EQ(result.outcomes[0].contact[Axis::z], -2);
  EXPECT_TRUE(result.outcomes[1].touched);
  EXPECT_DOUBLE_EQ(result.outcomes[1].contact[Axis::z], -2 + 1.0 / 640);
  EXPECT_TRUE(result.outcomes[2].refused);
  ASSERT_EQ(result.diagnostics.errors(), 1U);
  EXPECT_EQ(result.diagnostics.all()[0].code, "gcode.probe-before");
}

TEST(Probing, that_begins_in_contact_moves_nothing) {
  const MachineDescription router = example_machine("router");
  for (const char* code : {"G38.2", "G38.3"}) {
    const Probed result = run("G21 G90 F300\nG0 X3\n" + std::string(code) + " Z-5\nM2\n", router, below(Axis::z, 1));
    ASSERT_EQ(result.diagnostics.errors(), 1U);
    EXPECT_EQ(result.diagnostics.all()[0].code, "gcode.probe-before");
    EXPECT_EQ(result.end, test::xyz(3, 0));
  }
}

TEST(Probing, measures_a_tool_into_the_table_for_g43) {
  const MachineDescription router = example_machine("router");
  InterpreterOptions options;
  Tool tool;
  tool.number = 7;
  ASSERT_TRUE(options.tools.add(tool));
  options.tools.name = "t.tbl";
  const Probed result = run("G21 G90\nT7 M6\nF200 G38.2 Z-30\nG10 L1 P7 Z[#5063+40]\nG0 Z0\nG43 H7\nG0 Z30\nM2\n",
                            router, below(Axis::z, -12.5), nullptr, options);
  ASSERT_FALSE(result.diagnostics.any_error()) << render(result.diagnostics, false);
  ASSERT_NE(result.tools.find(7), nullptr);
  EXPECT_NEAR(result.tools.find(7)->offset[Axis::z], 27.5, 1e-9);
  EXPECT_NEAR(result.end[Axis::z], 57.5, 0.5 / 640);
}

TEST(Probing, an_error_that_only_the_run_finds_ends_it_at_rest_before_the_wrong_move) {
  const MachineDescription router = example_machine("router");
  const Probed result =
      run("G21 G90 M8 F600\nG38.2 Z-5\nG10 L20 P1 Z0\nG0 Z4\nX500\nX0\nM2\n", router, below(Axis::z, -2));
  ASSERT_GE(result.diagnostics.errors(), 1U);
  EXPECT_EQ(result.diagnostics.all()[0].code, "travel.exceeded");
  EXPECT_EQ(result.end[Axis::x], 0);
  EXPECT_NEAR(result.end[Axis::z], 2, 0.2);
  EXPECT_EQ(result.outputs.switches, 0);
}

TEST(Probing, a_guarded_machine_stops_at_a_contact_in_any_other_move) {
  MachineDescription router = example_machine("router");
  const std::string program = "G21 G90 F600\nG38.2 Z-5\nG0 Z5\nM3 S1000\nG0 X50\nG1 Z-5\nX0\nM2\n";
  EXPECT_FALSE(run(program, router, below(Axis::z, -2)).stopped_by_probe);
  router.probe.guards = true;
  const Probed result = run(program, router, below(Axis::z, -2));
  EXPECT_TRUE(result.stopped_by_probe);
  EXPECT_EQ(result.outcomes.size(), 1U);
  EXPECT_EQ(result.end[Axis::x], 50) << "moving off the plate is allowed";
  EXPECT_LE(result.end[Axis::z], -2);
  EXPECT_GE(result.end[Axis::z], -2 - 10 * 0.065 - 10 * 10 / (2 * 500.0) - 0.01);
  EXPECT_EQ(result.outputs.switches, 0);
}

ProgramCheck check(const std::string& program, const MachineDescription& machine, Diagnostics& diagnostics) {
  InterpreterOptions options;
  options.on_machine = true;
  return check_program(ProgramReader::from_text("t", program), machine, options, diagnostics);
}

TEST(ProbingCheck, takes_a_probe_as_touched_at_its_end_and_doubts_what_follows_from_that) {
  const MachineDescription router = example_machine("router");
  Diagnostics fine;
  EXPECT_TRUE(
      check("G21 G90 F100\nG38.2 Z-5\no1 if [#5070 EQ 0]\n(ABORT,no contact)\no1 endif\nM2\n", router, fine).good);
  EXPECT_TRUE(fine.all().empty()) << render(fine, false);

  Diagnostics doubted;
  const ProgramCheck result = check("G21 G90 F100\nG38.2 Z-100\nG10 L20 P1 Z0\nG1 Z-40\nM2\n", router, doubted);
  EXPECT_TRUE(result.good);
  EXPECT_TRUE(result.probes);
  ASSERT_EQ(doubted.all().size(), 1U);
  EXPECT_EQ(doubted.all()[0].code, "travel.exceeded");
  EXPECT_EQ(doubted.all()[0].severity, Severity::warning);
  EXPECT_NE(doubted.all()[0].message.find("if the probe is triggered at the end of its move"), std::string::npos);
}

TEST(ProbingCheck, still_refuses_what_is_written_wrong_and_what_is_wrong_before_the_probe) {
  const MachineDescription router = example_machine("router");
  Diagnostics written;
  EXPECT_FALSE(check("G21 G90 F100\nG38.2 Z-5\nG1 X[1+\nM2\n", router, written).good);
  Diagnostics before;
  EXPECT_FALSE(check("G21 G90 F100\nG0 Z-500\nG38.2 Z-5\nM2\n", router, before).good);
  Diagnostics too_far;
  EXPECT_FALSE(check("G21 G90 F100\nG38.2 Z-500\nM2\n", router, too_far).good);
}

}  // namespace
}  // namespace passo
