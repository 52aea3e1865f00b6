// Threads over a line: the encoder's counts come in the answers of the board, and what follows them in refills.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "pipeline/spindle_kit.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::Cut;
using test::grooves_at;
using test::ideal;
using test::lathe;
using test::play;
using test::Played;
using test::rippling;
using test::Spread;
using test::spread;
using test::thread_program;

// And by how much a groove may wander, and passes may lie beside each other, in mm; the second with limits of jerk.
struct LineCase {
  const char* name;
  LineOptions line;
  double wander[2];
  double apart[2];
};
const std::vector<LineCase>& lines() {
  static const std::vector<LineCase> all = {
      {"115,200, 1 ms", {.baud = 115'200, .latency = Seconds(0.001)}, {0.12, 0.2}, {0.12, 0.2}},
      {"500,000, 1 ms", {.baud = 500'000, .latency = Seconds(0.001)}, {0.016, 0.035}, {0.016, 0.035}},
      {"1,000,000, 1 ms", {.baud = 1'000'000, .latency = Seconds(0.001)}, {0.012, 0.06}, {0.012, 0.06}},
      {"500,000, 8 ms", {.baud = 500'000, .latency = Seconds(0.008)}, {0.08, 0.08}, {0.08, 0.08}}};
  return all;
}

Played run(const std::string& program, const MachineDescription& machine, const LineOptions& line) {
  const Played played = play(program, machine, {.line = line});
  EXPECT_FALSE(played.error) << message_of(*played.error);
  return played;
}

TEST(SpindleOverALine, a_thread_has_its_pitch) {
  for (const LineCase& each : lines()) {
    for (const bool jerk : {false, true}) {
      const Played even = run(thread_program("600"), lathe(ideal, jerk), each.line);
      const Played uneven = run(thread_program("600"), lathe(rippling, jerk), each.line);
      const double straight = spread(even.cuts, 1.5, -4, -19).mm(1.5);
      const double wander = spread(uneven.cuts, 1.5, -4, -19).mm(1.5);
      std::printf("%-16s %s: along 10 turns the groove wanders %.4f mm, without ripple %.4f mm\n", each.name,
                  jerk ? "jerk limited" : "", wander, straight);
      EXPECT_LT(straight, 0.02);
      EXPECT_LT(wander, each.wander[jerk ? 1 : 0]);
    }
  }
}

TEST(SpindleOverALine, all_passes_of_a_threading_cycle_lie_in_one_groove) {
  const std::string program = "G21 G18 S600 M3\nG0 X5 Z0\nG76 P1.5 Z-15 I-1 J0.2 K0.9 R1.5 H2\nM5\nM2\n";
  for (const LineCase& each : lines()) {
    for (const bool jerk : {false, true}) {
      const Played result = run(program, lathe(rippling, jerk), each.line);
      double worst = 0;
      std::size_t passes = 0;
      for (const double z : {-5.0, -8.0, -11.0, -14.0}) {
        Spread all;
        const std::vector<double> grooves = grooves_at(result.cuts, 1.5, z);
        for (const double pass : grooves) all.see(pass);
        passes = grooves.size();
        EXPECT_GE(passes, 8U);
        worst = std::max(worst, all.mm(1.5));
      }
      std::printf("%-16s %s: %zu passes of a G76 lie within %.4f mm of each other\n", each.name,
                  jerk ? "jerk limited" : "", passes, worst);
      EXPECT_LT(worst, each.apart[jerk ? 1 : 0]);
    }
  }
}

}  // namespace
}  // namespace passo
