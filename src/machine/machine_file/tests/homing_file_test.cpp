#include "machine_text.hpp"

namespace passo {
namespace {

const std::string homes = sound_machine + R"(
[axis.X.home]
direction = "low"
switch_at_mm = -151
seek_mm_s = 20
latch_mm_s = 1
pull_off_mm = 2

[axis.A.home]
direction = "high"
switch_at_deg = 180
seek_deg_s = 30
latch_deg_s = 2
pull_off_deg = 5
input = 0

[homing]
order = "AX"
)";

std::string codes_of(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(text, "m.toml", diagnostics));
  std::string codes;
  for (const Diagnostic& one : diagnostics.all()) codes += std::to_string(one.place.line) + " " + one.code + "\n";
  return codes;
}

TEST(HomingFile, tells_where_the_switches_are_and_in_which_order) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(homes, "m.toml", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  EXPECT_EQ(machine->homing, (std::vector<Axis>{Axis::a, Axis::x}));
  const HomeDescription& x = *machine->axes[0].home;
  EXPECT_FALSE(x.toward_high);
  EXPECT_EQ(x.switch_at, -151);
  EXPECT_EQ(x.rest(), -149);
  EXPECT_EQ(x.seek, MmPerSecond(20));
  EXPECT_EQ(x.latch, MmPerSecond(1));
  EXPECT_EQ(x.input, 0);
  const HomeDescription& a = *machine->axes[1].home;
  EXPECT_TRUE(a.toward_high);
  EXPECT_EQ(a.rest(), 175);
  EXPECT_EQ(a.input, 0) << "two switches in one chain";
  EXPECT_THAT(describe(*machine), testing::HasSubstr("homing          AX, one after the other\n"));
  EXPECT_THAT(describe(*machine),
              testing::HasSubstr("homed at limit 1 by its low end, -151 mm: 20 mm/s, then 1 mm/s; stops at -149 mm\n"));
}

TEST(HomingFile, takes_the_motors_own_switch_and_z_first) {
  std::string text = replaced(homes, "input = 0\n", "");
  text = replaced(text, "[homing]\norder = \"AX\"\n", "");
  Diagnostics diagnostics;
  const auto machine = parse_machine(text, "m.toml", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  EXPECT_EQ(machine->axes[1].home->input, 1);
  EXPECT_EQ(machine->homing, (std::vector<Axis>{Axis::x, Axis::a}));

  std::string third = text +
                      "\n[axis.Z]\nsteps_per_mm = 100\ntravel_mm = [-50, 0]\nmax_velocity_mm_s = 25\n"
                      "max_acceleration_mm_s2 = 200\nhome = {direction = 'high', switch_at_mm = 1, "
                      "seek_mm_s = 20, latch_mm_s = 1, pull_off_mm = 2}\n";
  const auto with_z = parse_machine(third, "m.toml", diagnostics);
  ASSERT_TRUE(with_z) << render(diagnostics, false);
  EXPECT_EQ(with_z->homing, (std::vector<Axis>{Axis::z, Axis::x, Axis::a}));
}

TEST(HomingFile, without_switches_nothing_is_homed) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(sound_machine, "m.toml", diagnostics);
  ASSERT_TRUE(machine);
  EXPECT_TRUE(machine->homing.empty());
  EXPECT_FALSE(machine->axes[0].home);
}

TEST(HomingFile, what_cannot_be_is_told_with_its_line) {
  EXPECT_EQ(codes_of(replaced(homes, "\"low\"", "\"left\"")), "30 machine.homing\n");
  EXPECT_EQ(codes_of(replaced(homes, "seek_mm_s = 20", "seek_mm_s = 26")), "32 machine.homing\n");
  EXPECT_EQ(codes_of(replaced(homes, "latch_mm_s = 1", "latch_mm_s = 21")), "33 machine.homing\n");
  EXPECT_EQ(codes_of(replaced(homes, "switch_at_mm = -151", "switch_at_mm = -152.1")), "31 machine.homing\n")
      << "pulled off it the machine has left its travel";
  EXPECT_EQ(codes_of(replaced(homes, "order = \"AX\"", "order = \"A\"")), "45 machine.homing\n");
  EXPECT_EQ(codes_of(replaced(homes, "order = \"AX\"", "order = \"AXX\"")), "45 machine.homing\n");
  EXPECT_EQ(codes_of(replaced(homes, "order = \"AX\"", "order = \"AxY\"")), "45 machine.homing\n");
  EXPECT_EQ(codes_of(replaced(homes, "pull_off_mm = 2\n", "")), "29 machine.missing-key\n");
  EXPECT_EQ(codes_of(replaced(homes, "input = 0", "input = 8")), "42 machine.out-of-range\n");
  EXPECT_EQ(codes_of(sound_machine + "\n[homing]\norder = \"X\"\n"), "30 machine.homing\n");
}

}  // namespace
}  // namespace passo
