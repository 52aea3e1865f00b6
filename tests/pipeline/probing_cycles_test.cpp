// The ready programs of the probe on the virtual machine: what they find is where it is, to the step.
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/stage_test.hpp"
#include "pipeline/probe_kit.hpp"
#include <gmock/gmock.h>

#include "passo/levelling/height_map.hpp"
#include "passo/probing/levelled_program.hpp"
#include "passo/probing/probing_cycle.hpp"

namespace passo {
namespace {

using test::below;
using test::example_machine;

// What a cycle has left behind.
struct CycleRun {
  SavedParameters parameters;
  ToolTable tools;
  std::string logged;   // by (LOG,…), line by line
  std::string printed;  // by (PRINT,…)
  Point end;
  std::string words;  // what was wrong

  double offset(Axis axis) const { return parameters.at(5221 + static_cast<int>(index_of(axis))); }
};

CycleRun run_text(const std::string& text, const MachineDescription& machine, const Point& start,
                  const std::vector<Touchable>& things) {
  CycleRun result;
  Diagnostics diagnostics;
  InterpreterOptions options;
  options.start = start;
  options.on_machine = true;
  options.tools.name = "tools";
  static_cast<void>(options.tools.add({.number = 7, .pocket = 7}));
  IdealPlant plant = plant_of(machine, start, things);
  test::DrivenProgram job(ProgramReader::from_text("cycle", text), machine, options, diagnostics, {.plant = &plant});
  job.program().operations().watch([&](const Operation& operation) {
    if (const auto* log = std::get_if<operation::Log>(&operation.what)) result.logged += std::string(log->text) + "\n";
    if (const auto* print = std::get_if<operation::Print>(&operation.what)) result.printed += print->text;
  });
  while (job.advance()) {
  }
  result.parameters = job.program().saved_parameters();
  result.tools = job.program().tools();
  result.words = render(diagnostics, false);
  const MachineCounts counts = job.machine().counts();
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    const auto steps = static_cast<double>(counts.motors[m].position);
    result.end[axis.axis] = (axis.inverted ? -steps : steps) / axis.steps_per_unit;
  }
  return result;
}

CycleRun run_cycle(const ProbingCycle& cycle, const MachineDescription& machine, const Point& start,
                   const std::vector<Touchable>& things) {
  auto program = probing_program(cycle);
  EXPECT_TRUE(program) << program.error();
  return run_text(*program, machine, start, things);
}

Point at(double x, double y, double z) {
  Point place;
  place[Axis::x] = x;
  place[Axis::y] = y;
  place[Axis::z] = z;
  return place;
}

double step_of(const MachineDescription& machine, Axis axis) {
  for (const AxisDescription& one : machine.axes) {
    if (one.axis == axis) return 1 / one.steps_per_unit;
  }
  return 0;
}

class ProbingCycles : public testing::Test {
 protected:
  // Within a step of where it is.
  void expect_found(const CycleRun& run, Axis axis, double truth) {
    EXPECT_NEAR(run.offset(axis), truth, step_of(machine_, axis) + 1e-9) << letter_of(axis) << ' ' << run.printed;
  }

  const MachineDescription machine_ = example_machine("router");
  TouchBox block_ = [] {
    TouchBox box;
    box.ranges[Axis::x] = {.low = 42.3, .high = 90.1};
    box.ranges[Axis::y] = {.low = 31.75, .high = 70.2};
    box.ranges[Axis::z] = {.low = -50, .high = -11.2};
    return box;
  }();
};

TEST_F(ProbingCycles, a_surface) {
  const CycleRun run = run_cycle({.kind = ProbingKind::surface, .height = 2.5}, machine_, at(50, 40, 0), {block_});
  EXPECT_EQ(run.words, "");
  expect_found(run, Axis::z, -11.2 - 2.5);
  EXPECT_NEAR(run.end[Axis::z], -11.2 + 5, 0.01);
}

// With M2, the tool would leave for the park position of such a machine.
TEST_F(ProbingCycles, stay_where_they_end_on_a_machine_that_parks) {
  MachineDescription machine = machine_;
  machine.park = {.place = at(10, 190, 0), .at_end = ParkDescription::AtEnd::park};
  const CycleRun run = run_cycle({.kind = ProbingKind::surface, .height = 2.5}, machine, at(50, 40, 0), {block_});
  EXPECT_EQ(run.words, "");
  EXPECT_NEAR(run.end[Axis::x], 50, 0.01);
  EXPECT_NEAR(run.end[Axis::y], 40, 0.01);
  EXPECT_NEAR(run.end[Axis::z], -11.2 + 5, 0.01);
}

TEST_F(ProbingCycles, an_edge_from_each_side_with_a_ball) {
  struct Case {
    const char* side;
    Axis axis;
    Point start;
    double edge;
  };
  for (const Case& one :
       {Case{"x+", Axis::x, at(30, 40, -15), 42.3 + 1}, Case{"x-", Axis::x, at(100, 40, -15), 90.1 - 1},
        Case{"y+", Axis::y, at(50, 20, -15), 31.75 + 1}, Case{"y-", Axis::y, at(50, 80, -15), 70.2 - 1}}) {
    // The virtual probe is a point: a ball of 2 mm touches 1 mm earlier than this point, so the edge found is 1 mm on.
    const CycleRun run =
        run_cycle({.kind = ProbingKind::edge, .side = one.side, .ball = 2}, machine_, one.start, {block_});
    EXPECT_EQ(run.words, "");
    expect_found(run, one.axis, one.edge);
  }
}

TEST_F(ProbingCycles, each_corner) {
  struct Case {
    const char* side;
    double x;
    double y;
  };
  for (const Case& one : {Case{"front-left", 42.3, 31.75}, Case{"front-right", 90.1, 31.75},
                          Case{"back-left", 42.3, 70.2}, Case{"back-right", 90.1, 70.2}}) {
    const Point start = at(one.x + (one.x < 60 ? 8 : -8), one.y + (one.y < 50 ? 9 : -9), 0);
    const CycleRun run = run_cycle({.kind = ProbingKind::corner, .side = one.side}, machine_, start, {block_});
    EXPECT_EQ(run.words, "");
    expect_found(run, Axis::x, one.x);
    expect_found(run, Axis::y, one.y);
    expect_found(run, Axis::z, -11.2);
    EXPECT_NEAR(run.end[Axis::x], one.x, 0.02);
    EXPECT_NEAR(run.end[Axis::y], one.y, 0.02);
  }
}

TEST_F(ProbingCycles, a_corner_whose_side_is_beyond_the_reach_ends_the_program_and_breaks_no_probe) {
  const CycleRun run = run_cycle({.kind = ProbingKind::corner, .side = "front-left", .touch = {.reach = 20}}, machine_,
                                 at(70, 40, 0), {block_});
  EXPECT_THAT(run.words, testing::HasSubstr("gcode.probe"));
  EXPECT_GE(run.end[Axis::z], -11.3);
}

// Four walls around a place, so a square bore.
std::vector<Touchable> walls() {
  std::vector<Touchable> all;
  for (const auto& [axis, low, high] : {std::tuple{Axis::x, -1e3, 40.3}, std::tuple{Axis::x, 60.9, 1e3},
                                        std::tuple{Axis::y, -1e3, 30.1}, std::tuple{Axis::y, 52.3, 1e3}}) {
    TouchBox wall = below(Axis::z, -5);
    wall.ranges[axis] = {.low = low, .high = high};
    all.emplace_back(wall);
  }
  return all;
}

TEST_F(ProbingCycles, the_middle_of_a_bore) {
  const CycleRun run = run_cycle({.kind = ProbingKind::bore}, machine_, at(45, 48, -8), walls());
  EXPECT_EQ(run.words, "");
  expect_found(run, Axis::x, (40.3 + 60.9) / 2);
  expect_found(run, Axis::y, (30.1 + 52.3) / 2);
  EXPECT_THAT(run.printed, testing::HasSubstr("the bore is 22.20"));
}

TEST_F(ProbingCycles, the_middle_of_a_boss) {
  const CycleRun run =
      run_cycle({.kind = ProbingKind::boss, .size_x = 50, .size_y = 40}, machine_, at(64, 53, -6), {block_});
  EXPECT_EQ(run.words, "");
  expect_found(run, Axis::x, (42.3 + 90.1) / 2);
  expect_found(run, Axis::y, (31.75 + 70.2) / 2);
  EXPECT_THAT(run.printed, testing::HasSubstr("wide along Y"));
}

TEST_F(ProbingCycles, the_length_of_a_tool) {
  TouchBox setter = below(Axis::z, -17.3);
  setter.ranges[Axis::x] = {.low = 95, .high = 105};
  const CycleRun run = run_cycle(
      {.kind = ProbingKind::tool, .touch = {.reach = 50}, .x = 100, .y = 80, .tool = {.number = 7, .zero_z = -40}},
      machine_, at(0, 0, -3), {setter});
  EXPECT_EQ(run.words, "");
  const Tool* const tool = run.tools.find(7);
  ASSERT_NE(tool, nullptr);
  EXPECT_NEAR(tool->offset[Axis::z], -17.3 + 40, step_of(machine_, Axis::z) + 1e-9);
}

TEST_F(ProbingCycles, the_angle_of_an_edge) {
  // A slanted edge: an STL-like surface of two triangles, upright seen from above.
  const double degrees = 3.7;
  const double slope = std::tan(degrees * std::numbers::pi / 180);
  const auto surface = std::make_shared<const Surface>(
      std::vector<SurfaceTriangle>{{SurfacePoint{0, 0, 0}, SurfacePoint{100, 100 * slope, 0}, SurfacePoint{100, 90, 0}},
                                   {SurfacePoint{0, 0, 0}, SurfacePoint{100, 90, 0}, SurfacePoint{0, 90, 0}}});
  const PlacedSurface work{.surface = surface, .zero = at(10, 20, -5)};
  const CycleRun run =
      run_cycle({.kind = ProbingKind::angle, .side = "y+", .along = 60}, machine_, at(25, 18, -8), {work});
  EXPECT_EQ(run.words, "");
  const double worst = 2 * step_of(machine_, Axis::y) / 60 * 180 / std::numbers::pi;
  EXPECT_NEAR(run.parameters.at(5230), degrees, worst);
}

// Two square bores in a plate that was turned over and put down elsewhere, turned a little.
std::vector<Touchable> plate_with_bores(double x1, double y1, double x2, double y2) {
  constexpr double half = 3;
  std::vector<SurfaceTriangle> triangles;
  const auto face = [&](double low_x, double high_x, double low_y, double high_y) {
    const auto corner = [](double x, double y) { return SurfacePoint{x, y, -5}; };
    triangles.push_back({corner(low_x, low_y), corner(high_x, low_y), corner(high_x, high_y)});
    triangles.push_back({corner(low_x, low_y), corner(high_x, high_y), corner(low_x, high_y)});
  };
  // Columns of the plate, those through a bore in two pieces.
  face(-100, x1 - half, -100, 200);
  face(x1 - half, x1 + half, -100, y1 - half);
  face(x1 - half, x1 + half, y1 + half, 200);
  face(x1 + half, x2 - half, -100, 200);
  face(x2 - half, x2 + half, -100, y2 - half);
  face(x2 - half, x2 + half, y2 + half, 200);
  face(x2 + half, 300, -100, 200);
  return {PlacedSurface{.surface = std::make_shared<const Surface>(triangles), .zero = {}}};
}

TEST_F(ProbingCycles, two_bores_tell_place_and_angle) {
  const ProbingCycle cycle{
      .kind = ProbingKind::bores, .touch = {.reach = 8}, .x = 5, .y = 40, .second_x = 75, .second_y = 40};
  // In the machine they are 70.02 mm apart, turned by 2.3 degrees.
  const double angle = 2.3 * std::numbers::pi / 180;
  const double x2 = 30 + 70.02 * std::cos(angle);
  const double y2 = 25 + 70.02 * std::sin(angle);
  const CycleRun run = run_cycle(cycle, machine_, at(31, 24, -8), plate_with_bores(30, 25, x2, y2));
  EXPECT_EQ(run.words, "");
  const double worst = 2 * step_of(machine_, Axis::y) / 70 * 180 / std::numbers::pi;
  const double found = run.parameters.at(5230);
  EXPECT_NEAR(found, 2.3, worst);
  // The work coordinate system puts the middle of both where it is in the machine, and both beside it along their line.
  const auto in_machine = [&](double x, double y) {
    const double turn = found * std::numbers::pi / 180;
    return std::pair(run.offset(Axis::x) + x * std::cos(turn) - y * std::sin(turn),
                     run.offset(Axis::y) + x * std::sin(turn) + y * std::cos(turn));
  };
  const double near = 0.01 + 2 * step_of(machine_, Axis::x);
  EXPECT_NEAR(in_machine(5, 40).first, 30, near);
  EXPECT_NEAR(in_machine(5, 40).second, 25, near);
  EXPECT_NEAR(in_machine(75, 40).first, x2, near);
  EXPECT_NEAR(in_machine(75, 40).second, y2, near);
}

TEST_F(ProbingCycles, bores_that_are_not_as_far_apart_as_they_should_be_end_the_program) {
  const ProbingCycle cycle{
      .kind = ProbingKind::bores, .touch = {.reach = 8}, .x = 5, .y = 40, .second_x = 75, .second_y = 40};
  const CycleRun run = run_cycle(cycle, machine_, at(31, 24, -8), plate_with_bores(30, 25, 101, 25));
  EXPECT_THAT(run.words, testing::HasSubstr("apart; they should be 70.0000 mm apart"));
  EXPECT_FALSE(probing_program({.kind = ProbingKind::bores, .second_x = 0, .second_y = 0}));
}

// Probed, levelled by what was probed, and run: the tool follows the surface.
TEST_F(ProbingCycles, a_map_is_exact_and_a_levelled_program_follows_it) {
  std::vector<SurfaceTriangle> triangles;
  const auto height = [](double x, double y) { return -12 + 0.02 * x - 0.03 * y + (x > 35 ? 0.05 * (x - 35) : 0); };
  const auto corner = [&](double x, double y) { return SurfacePoint{x, y, height(x, y)}; };
  for (const auto& [low, high] : {std::pair{0.0, 35.0}, std::pair{35.0, 80.0}}) {
    triangles.push_back({corner(low, 0), corner(high, 0), corner(high, 60)});
    triangles.push_back({corner(low, 0), corner(high, 60), corner(low, 60)});
  }
  const PlacedSurface work{.surface = std::make_shared<const Surface>(triangles), .zero = {}};
  ProbingCycle cycle{.kind = ProbingKind::map,
                     .clearance = 3,
                     .depth = 5,
                     .size_x = 50,
                     .size_y = 40,
                     .x = 10,
                     .y = 5,
                     .columns = 3,
                     .rows = 3};
  // The work's zero is at Z-12 of the machine.
  const std::string zero = "G10 L2 P1 X0 Y0 Z-12\n";
  const std::string program = probing_program(cycle)->insert(2, zero);  // behind the '%'
  const CycleRun run = run_text(program, machine_, at(0, 0, 0), {work});
  EXPECT_EQ(run.words, "");
  Diagnostics diagnostics;
  const auto map = read_height_map("log", run.logged, diagnostics);
  ASSERT_TRUE(map) << render(diagnostics, false);
  EXPECT_EQ(map->columns(), (std::vector<double>{10, 35, 60}));
  for (const double x : {10.0, 35.0, 60.0}) {
    for (const double y : {5.0, 25.0, 45.0})
      EXPECT_NEAR(map->height(x, y), height(x, y) + 12, 2 * step_of(machine_, Axis::z)) << x << ' ' << y;
  }
  std::string levelled;
  write_levelled_program(ProgramReader::from_text(
                             "part", "M3 S1000\nG0 X12 Y8 Z3\nG1 Z0 F800\nX55 Y40\nG2 X15 Y20 I-20 J-10\nG0 Z3\nM2\n"),
                         {}, *map, {.tolerance = 0.005}, diagnostics, [&](std::string_view text) { levelled += text; });
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  // The program's Z0 is the surface: nowhere is its path off by more than the tolerances and a few steps.
  Diagnostics findings;
  InterpreterOptions options;
  options.on_machine = true;
  options.parameters = run.parameters;
  double worst = 0;
  std::size_t looked = 0;
  check_program(ProgramReader::from_text("levelled", levelled), machine_, options, findings, [&](const PathItem& item) {
    const auto* segment = std::get_if<Segment>(&item);
    if (segment == nullptr || segment->rapid || segment->curve.start()[Axis::z] > -10) return;
    for (int i = 0; i <= 20; ++i) {
      const Point place = segment->curve.at(segment->curve.length() * (i / 20.0));
      if (segment->curve.start()[Axis::x] == segment->curve.end()[Axis::x] &&
          segment->curve.start()[Axis::y] == segment->curve.end()[Axis::y])
        continue;
      worst = std::max(worst, std::abs(place[Axis::z] - height(place[Axis::x], place[Axis::y])));
      ++looked;
    }
  });
  EXPECT_EQ(render(findings, false), "");
  EXPECT_GT(looked, 100U);
  EXPECT_LE(worst, 0.005 + 4 * step_of(machine_, Axis::z));
}

}  // namespace
}  // namespace passo
