#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "kit/seed.hpp"
#include "machine_text.hpp"

namespace passo {
namespace {

MachineDescription parsed(const std::string& text) {
  Diagnostics diagnostics;
  auto machine = parse_machine(text, "machine.toml", diagnostics);
  EXPECT_EQ(render(diagnostics, false), "");
  return machine.value_or(MachineDescription{});
}

TEST(MachineReader, reads_every_key_into_its_unit) {
  const MachineDescription machine = parsed(sound_machine);
  EXPECT_EQ(machine.name, "Test machine");
  EXPECT_EQ(machine.path_tolerance, Mm(0.02));
  EXPECT_EQ(machine.board.clock, Hertz(16e6));
  EXPECT_EQ(machine.board.highest_event_rate, Hertz(50e3));
  EXPECT_DOUBLE_EQ(machine.board.step_pulse.value(), 2.5e-6);
  EXPECT_EQ(machine.tool.name, "Spindle");
  EXPECT_EQ(machine.tool.highest_rpm, 10000);
  EXPECT_EQ(machine.tool.diameter, Mm(3));

  ASSERT_EQ(machine.axes.size(), 2U);
  const AxisDescription& x = machine.axes[0];
  EXPECT_EQ(x.axis, Axis::x);
  EXPECT_EQ(x.steps_per_unit, 100);
  EXPECT_EQ(x.travel_low, -150);
  EXPECT_EQ(x.travel_high, 150);
  EXPECT_EQ(x.velocity, MmPerSecond(25));
  EXPECT_EQ(x.acceleration, MmPerSecond2(200));
  EXPECT_FALSE(x.inverted);
  const AxisDescription& a = machine.axes[1];
  EXPECT_EQ(a.axis, Axis::a);
  EXPECT_EQ(a.steps_per_unit, 160);  // 200 * 8 * 36 / 360
  EXPECT_TRUE(a.inverted);
}

TEST(MachineReader, angles_have_a_tolerance_of_their_own) {
  EXPECT_EQ(parsed(sound_machine).path_tolerance_deg, 0.05);
  EXPECT_EQ(parsed("path_tolerance_deg = 0.2\n" + sound_machine).path_tolerance_deg, 0.2);
}

TEST(MachineReader, the_feed_may_be_that_of_a_cylinder) {
  EXPECT_FALSE(parsed(sound_machine).axes[1].surface_radius);
  const MachineDescription fixed = parsed(replaced(sound_machine, "[axis.A]\n", "[axis.A]\nradius_mm = 20\n"));
  EXPECT_EQ(fixed.axes[1].surface_radius, Mm(20));
  EXPECT_THAT(describe(fixed), testing::HasSubstr("feed at a radius of 20 mm\n"));
  const MachineDescription by_tool = parsed(replaced(sound_machine, "[axis.A]\n", "[axis.A]\nradius_mm = \"tool\"\n"));
  EXPECT_EQ(by_tool.axes[1].surface_radius, Mm(0));
  EXPECT_THAT(describe(by_tool), testing::HasSubstr("feed at the tool's radius\n"));
}

TEST(MachineReader, a_jerk_limit_may_be_given_and_is_none_otherwise) {
  EXPECT_EQ(parsed(sound_machine).axes[0].jerk, MmPerSecond3(0));
  const MachineDescription machine =
      parsed(replaced(replaced(sound_machine, "[axis.X]\n", "[axis.X]\nmax_jerk_mm_s3 = 5000\n"), "[axis.A]\n",
                      "[axis.A]\nmax_jerk_deg_s3 = 8000\n"));
  ASSERT_EQ(machine.axes.size(), 2U);
  EXPECT_EQ(machine.axes[0].jerk, MmPerSecond3(5000));
  EXPECT_EQ(machine.axes[1].jerk, MmPerSecond3(8000));
  EXPECT_THAT(describe(machine), testing::HasSubstr("200 mm/s2, 5000 mm/s3\n"));
  EXPECT_THAT(describe(machine), testing::HasSubstr("300 deg/s2, 8000 deg/s3, inverted\n"));

  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(replaced(sound_machine, "[axis.X]\n", "[axis.X]\nmax_jerk_mm_s3 = 0\n"), "machine.toml",
                             diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.all()[0].code, "machine.out-of-range");
}

TEST(MachineReader, an_axis_may_have_a_start_stop_velocity_up_to_its_velocity) {
  EXPECT_EQ(parsed(sound_machine).axes[0].start_stop, MmPerSecond(0));
  const MachineDescription machine =
      parsed(replaced(replaced(sound_machine, "[axis.X]\n", "[axis.X]\nstart_stop_velocity_mm_s = 2.5\n"), "[axis.A]\n",
                      "[axis.A]\nstart_stop_velocity_deg_s = 5\n"));
  EXPECT_EQ(machine.axes[0].start_stop, MmPerSecond(2.5));
  EXPECT_EQ(machine.axes[1].start_stop, MmPerSecond(5));
  const double rate = 2.5 * machine.axes[0].steps_per_unit;
  EXPECT_THAT(describe(machine), testing::HasSubstr("200 mm/s2, starts and stops at 2.5 mm/s (" +
                                                    std::to_string(std::lround(rate)) + " steps/s)\n"));

  Diagnostics diagnostics;
  const std::string faster = replaced(sound_machine, "[axis.X]\n", "[axis.X]\nstart_stop_velocity_mm_s = 1e4\n");
  EXPECT_FALSE(parse_machine(faster, "machine.toml", diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.all()[0].code, "machine.start-stop");
  EXPECT_EQ(diagnostics.all()[0].message.substr(0, 41), "the start-stop velocity of axis X, 10000 ");
  const std::string below = replaced(sound_machine, "[axis.X]\n", "[axis.X]\nstart_stop_velocity_mm_s = -1\n");
  EXPECT_FALSE(parse_machine(below, "machine.toml", diagnostics));
  EXPECT_EQ(diagnostics.all()[1].code, "machine.out-of-range");
}

TEST(MachineReader, takes_defaults_for_what_may_be_left_out) {
  const MachineDescription machine = parsed(
      "name = 'Plain'\n[board]\nclock_hz = 16e6\nmax_event_rate_hz = 50e3\n"
      "[axis.W]\nsteps_per_turn = 48\nscrew_pitch_mm = 0.5\ntravel_mm = [0, 10]\nmax_velocity_mm_s = 1\n"
      "max_acceleration_mm_s2 = 5\n");
  EXPECT_EQ(machine.path_tolerance, Mm(0.01));
  EXPECT_DOUBLE_EQ(machine.board.step_pulse.value(), 2.5e-6);
  EXPECT_EQ(machine.tool.highest_rpm, 0);
  ASSERT_EQ(machine.axes.size(), 1U);
  EXPECT_EQ(machine.axes[0].steps_per_unit, 96);
}

TEST(MachineReader, orders_motors_by_axis_letter_whatever_the_order_in_the_file) {
  std::string text = sound_machine;
  text += replaced(text.substr(text.find("[axis.X]"), text.find("[axis.A]") - text.find("[axis.X]")), "X", "U");
  text += replaced(text.substr(text.find("[axis.X]"), text.find("[axis.A]") - text.find("[axis.X]")), "X", "Y");
  std::string order;
  for (const AxisDescription& axis : parsed(text).axes) order += letter_of(axis.axis);
  EXPECT_EQ(order, "XYAU");
}

TEST(MachineReader, orders_motors_by_their_numbers_where_those_are_given) {
  const std::string text =
      replaced(replaced(sound_machine, "[axis.X]\n", "[axis.X]\nmotor = 1\n"), "[axis.A]\n", "[axis.A]\nmotor = 0\n");
  const MachineDescription machine = parsed(text);
  ASSERT_EQ(machine.axes.size(), 2U);
  EXPECT_EQ(machine.axes[0].axis, Axis::a);
  EXPECT_EQ(machine.axes[1].axis, Axis::x);
}

TEST(MachineReader, takes_a_byte_order_mark_and_windows_line_ends) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : sound_machine) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(parsed(text).axes.size(), 2U);
}

TEST(MachineReader, a_velocity_that_needs_just_every_event_is_allowed) {
  EXPECT_EQ(parsed(replaced(sound_machine, "max_velocity_mm_s = 25", "max_velocity_mm_s = 500")).axes[0].velocity,
            MmPerSecond(500));
}

// The promises of a description, checked without the file.
void expect_sound(const MachineDescription& machine, const std::string& text) {
  ASSERT_FALSE(machine.axes.empty()) << text;
  ASSERT_LE(machine.axes.size(), most_motors) << text;
  ASSERT_TRUE(std::isfinite(machine.path_tolerance.value()) && machine.path_tolerance > Mm(0)) << text;
  ASSERT_LE(machine.board.highest_event_rate.value() * 16, machine.board.clock.value()) << text;
  for (const AxisDescription& axis : machine.axes) {
    ASSERT_TRUE(std::isfinite(axis.steps_per_unit) && axis.steps_per_unit > 0) << text;
    ASSERT_LT(axis.travel_low, axis.travel_high) << text;
    ASSERT_TRUE(std::isfinite(axis.acceleration.value()) && axis.acceleration > MmPerSecond2(0)) << text;
    ASSERT_GT(axis.velocity, MmPerSecond(0)) << text;
    ASSERT_LE(axis.velocity.value() * axis.steps_per_unit, machine.board.highest_event_rate.value() * 1.000001) << text;
  }
}

TEST(MachineReader, a_spoiled_file_gives_a_sound_machine_or_diagnostics_and_never_both) {
  std::mt19937_64 random(test::seed());
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  static const std::string spice = "=[]{}\".,#-+e0159_\n\r\t nXYZ'\\\0\x80\xff";
  int sound = 0;
  int wrong = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string text = sound_machine;
    for (std::size_t edits = 1 + below(3); edits > 0; --edits) {
      const std::size_t place = below(text.size());
      const std::size_t other = below(text.size());
      const std::size_t length = 1 + below(30);
      switch (below(3)) {
        case 0: text[place] = spice[below(spice.size())]; break;
        case 1: text.erase(place, length); break;
        default: text.insert(place, std::string(text, other, length)); break;
      }
    }
    Diagnostics diagnostics;
    const auto machine = parse_machine(text, "spoiled.toml", diagnostics);
    ASSERT_NE(machine.has_value(), diagnostics.any_error()) << text;
    ++(machine ? sound : wrong);
    if (machine) {
      ASSERT_NO_FATAL_FAILURE(expect_sound(*machine, text));
    }
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      ASSERT_TRUE(diagnostic.code.starts_with("machine.")) << diagnostic.code;
      ASSERT_LE(diagnostic.place.column, diagnostic.text.size() + 1) << render(diagnostic, false) << text;
    }
  }
  // Both kinds occur with any seed.
  EXPECT_GT(sound, 20);
  EXPECT_GT(wrong, 1000);
}

}  // namespace
}  // namespace passo
