#include "machine_text.hpp"

namespace passo {
namespace {

std::string codes_of_pins(const std::string& more) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(sound_machine + more, "m.toml", diagnostics));
  std::string codes;
  for (const Diagnostic& one : diagnostics.all()) codes += one.code + " " + one.expected + "\n";
  return codes;
}

MachineDescription machine_with(const std::string& more) {
  Diagnostics diagnostics;
  auto machine = parse_machine(sound_machine + more, "m.toml", diagnostics);
  EXPECT_TRUE(machine) << render(diagnostics, false);
  return machine.value_or(MachineDescription());
}

std::string home_of(const std::string& axis, const std::string& more = "") {
  return "\n[axis." + axis + ".home]\ndirection = \"low\"\nswitch_at_mm = -151\nseek_mm_s = 2\nlatch_mm_s = 1\n" +
         "pull_off_mm = 2\n" + more;
}

TEST(PinsFile, tells_the_levels_of_inputs_and_outputs) {
  const MachineDescription machine = machine_with(R"(
[inputs]
limits = ["high", "low", "high"]
emergency_stop = "high"
probe = "low"

[outputs]
step = "low"
driver_enable = "high"
flood = "low"
drivers_off_after_s = 12.5
enable_wait_s = 0.2
)");
  const PinsDescription& pins = machine.pins;
  EXPECT_EQ(pins.limits_high, (std::array<bool, most_motors>{true, false, true}));
  EXPECT_TRUE(pins.emergency_stop_high && pins.step_low && pins.driver_enable_high && pins.flood_low);
  EXPECT_FALSE(pins.probe_high || pins.mist_low);
  EXPECT_EQ(pins.drivers_off_after, Seconds(12.5));
  EXPECT_EQ(pins.enable_wait, Seconds(0.2));
  EXPECT_THAT(describe(machine), testing::HasSubstr("ready 0.2 s after they are enabled\n"));
  EXPECT_THAT(describe(machine), testing::HasSubstr("on when high: limit 1, limit 3, emergency stop, drivers\n"));
  EXPECT_THAT(describe(machine), testing::HasSubstr("on when low: step, flood\n"));
}

TEST(PinsFile, refuses_what_is_no_level) {
  EXPECT_EQ(codes_of_pins("[inputs]\nprobe = \"up\"\n"), "machine.level \"low\" or \"high\"\n");
  EXPECT_EQ(codes_of_pins("[inputs]\nlimits = [\"low\", true]\n"),
            "machine.level a list of at most 8, each \"low\" or \"high\"\n");
  EXPECT_THAT(codes_of_pins("[inputs]\nlimits = \"high\"\n"), testing::StartsWith("machine.wrong-type a list of"));
  EXPECT_THAT(codes_of_pins("[outputs]\ndrivers_off_after_s = 0.15\n"), testing::StartsWith("machine.silence "));
  EXPECT_THAT(codes_of_pins("[outputs]\nspindel = \"low\"\n"), testing::HasSubstr("perhaps spindle"));
}

TEST(WorkOfAMachine, has_usual_values_that_are_checked) {
  Diagnostics none;
  EXPECT_TRUE(parse_machine(std::string(sound_machine) + "[work]\nclearance_mm = 5\ndepth_mm = -2\n", "m.toml", none));
  EXPECT_EQ(codes_of_pins("[work]\nclearance_mm = -5\n"), "machine.out-of-range a number from 0.01 to 1000\n");
  EXPECT_EQ(codes_of_pins("[work]\ndepth_mm = 2\n"), "machine.out-of-range a number from -1000 to -0.001\n");
  EXPECT_THAT(codes_of_pins("[work]\nclearence_mm = 5\n"), testing::HasSubstr("perhaps clearance_mm"));
}

TEST(PinsFile, tells_of_windings_on_the_pins_of_the_board) {
  std::string text = sound_machine;
  const std::string board = "[board]\n";
  const std::size_t in_board = text.find(board) + board.size();
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(text, "m.toml", diagnostics)->board.windings);
  const auto machine =
      parse_machine(std::string(text).insert(in_board, "windings = \"wave\"\n"), "m.toml", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  EXPECT_EQ(machine->board.windings->name(), "wave");
  for (const char* const wrong : {"microsteps:4", "waves"}) {
    Diagnostics found;
    EXPECT_FALSE(parse_machine(std::string(text).insert(in_board, "windings = \"" + std::string(wrong) + "\"\n"),
                               "m.toml", found));
    EXPECT_EQ(found.all().front().code, "machine.windings");
  }
}

TEST(PinsFile, tells_of_a_second_motor) {
  const MachineDescription machine =
      machine_with(home_of("X") + "[axis.X.second_motor]\ninverted = true\nsquare_mm = 0.2\nskew_mm = -1\n");
  const std::uint8_t own = static_cast<std::uint8_t>(machine.axes.size());
  ASSERT_TRUE(machine.axes[0].second);
  EXPECT_EQ(machine.motor_count(), own + 1);
  EXPECT_EQ(machine.second_motor_of(0), own) << "after those of all axes";
  EXPECT_EQ(machine.axes[0].second->input, own);
  EXPECT_TRUE(machine.axes[0].second->inverted);
  EXPECT_EQ(machine.axes[0].second->square, 0.2);
  EXPECT_EQ(machine.axes[0].home_switches(), 1U | 1U << own);
}

TEST(PinsFile, refuses_two_motors_with_one_switch) {
  EXPECT_THAT(codes_of_pins(home_of("X") + "[axis.X.second_motor]\ninput = 0\n"),
              testing::StartsWith("machine.homing a separate switch for each motor"));
}

}  // namespace
}  // namespace passo
