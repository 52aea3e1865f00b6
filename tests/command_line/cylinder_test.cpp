// The feed on a cylinder that an axis turns, from the steps of `passo run`.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "kit/command_line.hpp"
#include <fmt/format.h>

namespace {

using passo::test::Outcome;
using passo::test::read;

class Cylinder : public passo::test::CommandLine {};

// Steps of 0.001 mm and 0.001 degrees. A cylinder with a radius of 20 mm is turned about X.
constexpr const char* cylinder_machine = R"(name = "Cylinder"
[board]
clock_hz = 16_000_000
max_event_rate_hz = 200_000
[axis.X]
steps_per_mm = 1000
travel_mm = [-50, 50]
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
[axis.Z]
steps_per_mm = 1000
travel_mm = [-50, 50]
max_velocity_mm_s = 100
max_acceleration_mm_s2 = 1000
[axis.A]
steps_per_deg = 1000
travel_deg = [-360, 360]
max_velocity_deg_s = 180
max_acceleration_deg_s2 = 3000
)";

// A circle with a radius of 15 mm on that cylinder, in chords.
std::string circle_on_a_cylinder(const std::string& before, bool by_time) {
  const double per_degree = 20 * std::numbers::pi / 180;
  const int chords = 720;
  std::string text = before;
  for (int i = 1; i <= chords; ++i) {
    const double angle = 2 * std::numbers::pi * i / chords;
    text += fmt::format("G1 X{:.4f} A{:.4f}", 15 * std::sin(angle), 15 * (1 - std::cos(angle)) / per_degree);
    text += by_time ? fmt::format(" F{:.4f}\n", 600 / (2 * std::numbers::pi * 15 / chords)) : "\n";
  }
  return text + "M2\n";
}

// The least and the greatest speed of the surface, over windows of 1 s away from the ends.
std::pair<double, double> surface_speeds(const std::string& trace) {
  const double per_degree = 20 * std::numbers::pi / 180;
  std::istringstream lines(trace);
  std::string line;
  std::getline(lines, line);
  double x = 0;
  double a = 0;
  double last_angle = 0;
  double whole = 0;  // turns already made, in radians
  std::vector<std::pair<double, double>> ways;
  while (std::getline(lines, line)) {
    double t = 0;
    int dx = 0;
    int dz = 0;
    int da = 0;
    if (std::sscanf(line.c_str(), "%lf,%d,%d,%d", &t, &dx, &dz, &da) != 4) continue;
    x += dx / 1000.0;
    a += da / 1000.0;
    double angle = std::atan2(x, 15 - a * per_degree);
    if (angle - last_angle < -std::numbers::pi) whole += 2 * std::numbers::pi;
    if (angle - last_angle > std::numbers::pi) whole -= 2 * std::numbers::pi;
    last_angle = angle;
    ways.emplace_back(t, 15 * (angle + whole));
  }
  std::pair<double, double> speeds{1e9, 0};
  std::size_t behind = 0;
  for (const auto& [t, way] : ways) {
    if (t > ways.back().first - 0.3) break;
    while (ways[behind + 1].first < t - 1) ++behind;
    if (t < 2.3) continue;
    const double speed = (way - ways[behind].second) / (t - ways[behind].first);
    speeds = {std::min(speeds.first, speed), std::max(speeds.second, speed)};
  }
  return speeds;
}

TEST_F(Cylinder, the_feed_on_a_cylinder_is_that_of_its_surface) {
  const auto speeds = [&](const std::string& radius, const std::string& before, bool by_time = false) {
    write("c.toml", cylinder_machine + radius);
    write("c.ngc", circle_on_a_cylinder(before, by_time));
    const Outcome outcome = passo("run " + path("c.ngc") + " -m " + path("c.toml") + " -q --trace " + path("c.csv"));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return surface_speeds(read(path("c.csv")));
  };
  // Curves that are fitted to chords are up to 0.2 % slower than the feed.
  const auto expect_even = [](std::pair<double, double> found) {
    EXPECT_NEAR(found.first, 9.992, 0.015);
    EXPECT_NEAR(found.second, 9.992, 0.01);
  };
  expect_even(speeds("radius_mm = 20\n", "G21 G64 P0.01 F600\n"));
  expect_even(speeds("radius_mm = 20\nmax_jerk_deg_s3 = 30000\n", "G21 G64 P0.01 F600\n"));
  expect_even(speeds("radius_mm = \"tool\"\n", "G21 G64 P0.01 F600\nG0 Z20\n"));
  EXPECT_GT(speeds("", "G21 G64 P0.01 F600\n").second, 15);
  // In inverse time the program says how long each chord takes.
  const auto timed = speeds("radius_mm = 20\n", "G21 G64 P0.01 G93\n", true);
  EXPECT_NEAR(timed.first, 10, 0.05);
  EXPECT_NEAR(timed.second, 10, 0.05);
}

TEST_F(Cylinder, a_feed_at_the_rotation_axis_is_bounded) {
  write("c.toml", std::string(cylinder_machine) + "radius_mm = \"tool\"\n");
  write("c.ngc", "G21 F600\nG1 A90\nG1 X10 A0 Z5\nG1 X0 A90 Z0\nM2\n");
  const Outcome outcome = passo("check " + path("c.ngc") + " -m " + path("c.toml") + " --motion");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
}

}  // namespace
