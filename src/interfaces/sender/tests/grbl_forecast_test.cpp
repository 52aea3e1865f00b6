#include "passo/sender/grbl_forecast.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

GrblLimits router() {
  GrblMachine machine;
  machine.axes = "XYZ";
  for (const char* line : {"$11=0.010", "$12=0.002", "$100=400", "$101=400", "$102=400", "$110=6000", "$111=6000",
                           "$112=3000", "$120=500", "$121=500", "$122=250"}) {
    machine.hear(line);
  }
  return limits_of(machine);
}

constexpr GrblLine network{.bytes_per_second = 0, .buffer = 1023};

TEST(GrblForecast, takes_the_limits_that_the_board_reports) {
  const GrblLimits limits = router();
  EXPECT_EQ(limits.velocity[Axis::z], MmPerSecond(50));
  EXPECT_EQ(limits.acceleration[Axis::z], MmPerSecond2(250));
  EXPECT_EQ(limits.steps_per_mm[Axis::y], 400);
  EXPECT_EQ(limits.steps_per_mm[Axis::a], 0);
  EXPECT_EQ(limits.junction_deviation, Mm(0.01));
  EXPECT_EQ(limits.blocks, 15U);
}

TEST(GrblForecast, reads_modal_lines_from_the_work_zero) {
  Point zero;
  zero[Axis::x] = 100;
  Point start = zero;
  GrblForecast forecast(router(), network, start, zero);
  forecast.add("G21G90", 1);
  forecast.add("G1F3000X50", 2);
  forecast.add("M3S1000", 3);
  forecast.add("X0", 4);
  forecast.add("G4P1.5", 5);
  forecast.add("G0Z5", 6);
  const double move = 50.0 / 50 + 50.0 / 500;
  EXPECT_NEAR(forecast.finish().time.value(), 2 * move + 1.5 + 2 * std::sqrt(5.0 / 250), 1e-9);
}

TEST(GrblForecast, measures_arcs_along_their_chords) {
  GrblForecast forecast(router(), network, {}, {});
  forecast.add("G3F600X-20Y0Z0I-10J0", 1);
  forecast.add("X0Y0Z0I10J0", 2);
  const double circle = 2 * std::numbers::pi * 10;
  EXPECT_NEAR(forecast.finish().time.value(), circle / 10 + 10.0 / 500, 0.005);
}

// GrblCode writes the F with which the tool has the programmed feed, here 10 mm/s.
TEST(GrblForecast, knows_that_a_core_xy_measures_its_motors) {
  GrblMachine machine;
  machine.axes = "XYZ";
  for (const char* line : {"[OPT:VC,15,128]", "$11=0.010", "$12=0.002", "$100=400", "$101=400", "$102=400", "$110=6000",
                           "$111=6000", "$112=6000", "$120=100000", "$121=100000", "$122=100000"}) {
    machine.hear(line);
  }
  const auto time = [&](const char* line) {
    GrblForecast forecast(limits_of(machine), network, {}, {});
    forecast.add(line, 1);
    return forecast.finish().time.value();
  };
  EXPECT_NEAR(time("G1F848.528X100Y0Z0"), 10, 1e-3);
  EXPECT_NEAR(time("G1F848.528X100Y100Z0"), std::sqrt(2) * 10, 1e-3);
  EXPECT_NEAR(time("G1F600X0Y0Z50"), 5, 1e-3);
  EXPECT_NEAR(time("G3F848.528X-20Y0Z0I-10J0"), std::numbers::pi, 5e-3);
  EXPECT_NEAR(time("G93G1F6X100Y100Z20"), 10, 1e-3);
  // $110 and $111 are the motors' speeds: 100 mm/s. Along a diagonal one motor makes the whole way.
  EXPECT_NEAR(time("G0X100Y0Z0"), 1, 2e-3);
  EXPECT_NEAR(time("G0X100Y100Z0"), 2, 2e-3);
}

// grblHAL converts F itself, in each chord of an arc too (kinematics/corexy.c); its planner works with the motors.
TEST(GrblForecast, knows_that_a_core_xy_with_grblhal_measures_the_tool) {
  for (const char* kinematics : {"[KINEMATICS:CoreXY v2.02]", "[OPT:VNMCL+,100,1024,3,0]"}) {
    GrblMachine machine;
    for (const char* line :
         {"[FIRMWARE:grblHAL]", "[AXS:3:XYZ]", kinematics, "$11=0.010", "$12=0.002", "$100=400", "$101=400", "$102=400",
          "$110=6000", "$111=6000", "$112=6000", "$120=100000", "$121=100000", "$122=100000"}) {
      machine.hear(line);
    }
    EXPECT_TRUE(machine.is_core_xy());
    EXPECT_FALSE(machine.measures_motors());
    const auto time = [&](const char* line) {
      GrblForecast forecast(limits_of(machine), network, {}, GrblTarget::of(machine));
      forecast.add(line, 1);
      return forecast.finish().time.value();
    };
    EXPECT_NEAR(time("G1F600X100Y0Z0"), 10, 1e-3);
    EXPECT_NEAR(time("G1F600X100Y100Z0"), std::sqrt(2) * 10, 1e-3);
    EXPECT_NEAR(time("G1F600X0Y0Z50"), 5, 1e-3);
    EXPECT_NEAR(time("G3F600X-20Y0Z0I-10J0"), std::numbers::pi, 5e-3);
    EXPECT_NEAR(time("G18G3F600X-20Y0Z0I-10K0"), std::numbers::pi, 5e-3) << "each chord has a factor of its own";
    EXPECT_NEAR(time("G0X100Y0Z0"), 1, 2e-3);
    EXPECT_NEAR(time("G0X100Y100Z0"), 2, 2e-3) << "one motor makes the whole way";
    // A motor that makes the whole way of a diagonal limits its feed.
    EXPECT_NEAR(time("G1F6000X100Y100Z0"), 2, 2e-3);
  }
}

// 0.1 mm per line at 100 mm/s: a thousand lines a second, and the connection carries half of them.
TEST(GrblForecast, tells_what_the_connection_costs_and_which_feed_it_carries) {
  constexpr double line = 11520 / 24.0;  // lines per second
  const auto run = [](double feed) {
    GrblLimits limits = router();
    limits.blocks = 100;
    GrblForecast forecast(limits, {}, {}, {});
    for (int i = 1; i <= 20'000; ++i) forecast.add(fmt::format("G1F{}X{:09.4f}Y0.000", feed, 0.1 * i), 7);
    return forecast.finish();
  };
  const GrblForecast::Result fast = run(1800);
  EXPECT_NEAR(fast.feed_carried.value(), 0.1 * line, 0.1);
  EXPECT_EQ(fast.densest_line, 7U);
  EXPECT_NEAR(fast.time.value(), fast.unhindered.value(), 0.01) << "30 mm/s are below 48";
  const GrblForecast::Result faster = run(4800);
  EXPECT_GT(faster.time.value(), 20'000 / line) << "the last byte of a line must have arrived";
  EXPECT_LT(faster.time.value(), 20'000 / line * 1.02);
  EXPECT_NEAR(faster.unhindered.value(), 2000.0 / 80 + 80.0 / 500, 0.01);
}

// The programs of ../shared/peers/motion-mm on grblHAL's simulator, whose times stand in the README there. The
// simulator reads its input at 115,200 baud, also from the network: the 122,327 bytes of p02 alone take 10.6 s.
TEST(GrblForecast, is_within_a_percent_of_grblhal) {
  const std::filesystem::path folder = std::filesystem::path(PASSO_SOURCE_DIR) / "../shared/peers/motion-mm";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no ../shared/peers/motion-mm beside this checkout";
  std::ifstream readme(folder / "README.md");
  static const std::regex pattern(R"(\| (p\d\d) .*\| ([0-9.]+) \|$)");  // the last column
  int compared = 0;
  for (std::string row; std::getline(readme, row);) {
    std::smatch found;
    if (!std::regex_match(row, found, pattern)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (!entry.path().filename().string().starts_with(found[1].str() + "_")) continue;
      GrblLimits limits = router();
      limits.acceleration[Axis::z] = MmPerSecond2(500);
      limits.blocks = 100;
      GrblForecast forecast(limits, {.bytes_per_second = 11520, .buffer = 1023}, {}, {});
      std::ifstream program(entry.path());
      for (std::string line; std::getline(program, line);) {
        if (!line.empty() && line[0] != '(' && line[0] != '%') forecast.add(line, 0);
      }
      const double ratio = forecast.finish().time.value() / std::stod(found[2]);
      fmt::print("{:.4f} of grblHAL's time: {}\n", ratio, entry.path().filename().string());
      EXPECT_NEAR(ratio, 1, 0.01) << entry.path().filename();
      ++compared;
    }
  }
  EXPECT_EQ(compared, 6);
}

}  // namespace
}  // namespace passo
