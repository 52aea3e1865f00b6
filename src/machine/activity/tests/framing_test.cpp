#include "passo/activity/framing.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passo/activity/program.hpp"

namespace passo {
namespace {

constexpr const char* router = R"(name = "Router"
[board]
clock_hz = 16_000_000
max_event_rate_hz = 50_000
[tool]
max_rpm = 10000
[axis.X]
steps_per_mm = 100
travel_mm = [0, 300]
max_velocity_mm_s = 50
max_acceleration_mm_s2 = 200
[axis.Y]
steps_per_mm = 100
travel_mm = [0, 200]
max_velocity_mm_s = 50
max_acceleration_mm_s2 = 200
[axis.Z]
steps_per_mm = 100
travel_mm = [-80, 0]
max_velocity_mm_s = 25
max_acceleration_mm_s2 = 200
)";

MachineDescription machine_of(const std::string& text = router) {
  Diagnostics diagnostics;
  auto machine = parse_machine(text, "m.toml", diagnostics);
  EXPECT_TRUE(machine) << render(diagnostics, false);
  return machine.value_or(MachineDescription());
}

// The segments of a program that starts at `start`, with a work zero at X50 Y40 Z-60.
std::vector<Segment> segments_of(const std::string& text, const Point& start = {}, bool warns = true) {
  InterpreterOptions options;
  options.parameters = {{5221, 50}, {5222, 40}, {5223, -60}};
  options.start = start;
  options.on_machine = true;
  Diagnostics findings;
  std::vector<Segment> segments;
  const ProgramCheck check =
      check_program(ProgramReader::from_text("p.ngc", text), machine_of(), options, findings, [&](const PathItem& one) {
        if (const auto* segment = std::get_if<Segment>(&one)) segments.push_back(*segment);
      });
  EXPECT_TRUE(check.good) << render(findings, false) << text;
  EXPECT_TRUE(warns || findings.all().empty()) << render(findings, false) << text;
  return segments;
}

JobOutline outline_of(const std::string& text) {
  JobOutline outline;
  for (const Segment& one : segments_of(text)) outline.add(one);
  return outline;
}

constexpr const char* triangle =
    "G21 G90\nM3 S1000\nG0 Z5\nG0 X90 Y100\nG1 Z-2 F600\nG1 X10\nG1 X50 Y20\nG1 X90 Y100\nG0 Z5\nG0 X0 Y0\nM2\n";

TEST(JobOutline, has_the_extents_of_the_feed_moves_and_the_top_of_all) {
  const JobOutline outline = outline_of(triangle);
  EXPECT_FALSE(outline.empty());
  EXPECT_EQ(outline.low(), (JobOutline::Spot{60, 60}));
  EXPECT_EQ(outline.high(), (JobOutline::Spot{140, 140}));
  EXPECT_EQ(outline.top(), -55);
  EXPECT_EQ(outline.work_zero()[Axis::z], -60);
  EXPECT_EQ(outline.hull(), (std::vector<JobOutline::Spot>{{60, 140}, {100, 60}, {140, 140}}));
  EXPECT_EQ(outline_of(triangle).top(), outline_of("G21 G90\nM3 S1000\nG0 Z5\nG1 Z-2 F600\nG53 G0 Z0\nM2\n").top())
      << "not the way to a park position";
  EXPECT_TRUE(outline_of("G21 G90\nG0 X10\nM2\n").empty());
}

// Each corner of the hull lies on the circle, and the hull is nowhere farther inside than is promised.
TEST(JobOutline, stays_small_and_close_to_a_round_job) {
  JobOutline outline;
  constexpr int corners = 300'000;
  constexpr double radius = 100;
  Point before;
  before[Axis::x] = radius;
  for (int i = 1; i <= corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    Point place;
    place[Axis::x] = radius * std::cos(angle);
    place[Axis::y] = radius * std::sin(angle);
    outline.add(Segment{.curve = Curve::line(before, place)});
    before = place;
  }
  const auto hull = outline.hull();
  EXPECT_LT(hull.size(), 9000U);
  EXPECT_GE(hull.size(), 500U);
  double least = radius;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const auto& next = hull[(i + 1) % hull.size()];
    least = std::min(least, std::hypot(hull[i][0] + next[0], hull[i][1] + next[1]) / 2);
    EXPECT_NEAR(std::hypot(hull[i][0], hull[i][1]), radius, 1e-9);
  }
  EXPECT_GT(least, radius * (1 - 2e-5));
}

TEST(JobOutline, has_whole_circles) {
  const auto hull = outline_of("G21 G90\nM3 S1000\nG0 Z5\nG0 X0 Y30\nG1 Z-1 F600\nG2 J-20\nG0 Z5\nM2\n").hull();
  ASSERT_GT(hull.size(), 100U);
  double lowest = 1e9;
  for (const auto& corner : hull) {
    EXPECT_NEAR(std::hypot(corner[0] - 50, corner[1] - 50), 20, 1e-6);
    lowest = std::min(lowest, corner[1]);
  }
  EXPECT_NEAR(lowest, 30, 20 * 4e-4);
}

TEST(Framing, rises_first_and_goes_around_the_extents) {
  const auto text = framing_program(outline_of(triangle), {.height = 2, .feed = 1200}, machine_of(), "part (1).ngc");
  ASSERT_TRUE(text) << text.error().text;
  EXPECT_NE(text->find("(frame of part _1_.ngc: the extents)"), std::string::npos) << *text;
  Point start;
  start[Axis::x] = 200;
  start[Axis::z] = -58;
  const std::vector<Segment> all = segments_of(*text, start, false);
  ASSERT_EQ(all.size(), 8U) << *text;
  EXPECT_EQ(all[0].curve.end()[Axis::x], 200) << "Z alone";
  EXPECT_EQ(all[0].curve.end()[Axis::z], -55);
  EXPECT_EQ(all[1].curve.end()[Axis::x], 60);
  EXPECT_EQ(all[1].curve.end()[Axis::y], 60);
  EXPECT_EQ(all[1].curve.end()[Axis::z], -55);
  EXPECT_EQ(all[2].curve.end()[Axis::z], -58) << "2 mm above the work zero";
  const JobOutline::Spot around[] = {{140, 60}, {140, 140}, {60, 140}, {60, 60}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Segment& side = all[3 + i];
    EXPECT_FALSE(side.rapid);
    EXPECT_NEAR(side.speed.value(), 20, 1e-9);
    EXPECT_EQ(side.curve.end()[Axis::x], around[i][0]);
    EXPECT_EQ(side.curve.end()[Axis::y], around[i][1]);
    EXPECT_EQ(side.curve.end()[Axis::z], -58);
  }
  EXPECT_EQ(all.back().curve.end()[Axis::z], -55);
}

TEST(Framing, never_lowers_the_tool_before_it_moves_sideways) {
  const auto text = framing_program(outline_of(triangle), {.hull = true}, machine_of(), "p");
  ASSERT_TRUE(text);
  const std::vector<Segment> all = segments_of(*text, {}, false);  // from the top, Z0
  ASSERT_EQ(all.size(), 5U) << *text;
  EXPECT_EQ(all[0].curve.end()[Axis::x], 60);
  EXPECT_EQ(all[0].curve.end()[Axis::z], 0) << "as high as it was";
  EXPECT_EQ(all[1].curve.end()[Axis::z], -55);
  EXPECT_EQ(all[2].curve.end()[Axis::x], 100) << "the hull";
}

TEST(Framing, is_refused_with_the_reason) {
  const auto code = [](const JobOutline& outline, const Framing& framing, const MachineDescription& machine) {
    const auto text = framing_program(outline, framing, machine, "p");
    return text ? std::string() : text.error().code;
  };
  const JobOutline outline = outline_of(triangle);
  EXPECT_EQ(code(outline, {}, machine_of()), "");
  EXPECT_EQ(code({}, {}, machine_of()), "framing.no-feeds");
  EXPECT_EQ(code(outline, {.feed = 0}, machine_of()), "framing.value");
  EXPECT_EQ(code(outline, {.height = std::nan("")}, machine_of()), "framing.value");
  EXPECT_EQ(code(outline, {.clearance = 61}, machine_of()), "goto.outside");
  EXPECT_EQ(code(outline, {.height = -21}, machine_of()), "goto.outside");
  MachineDescription lathe = machine_of();
  lathe.axes.erase(lathe.axes.begin() + 1);
  EXPECT_EQ(code(outline, {}, lathe), "framing.no-plane");
}

}  // namespace
}  // namespace passo
