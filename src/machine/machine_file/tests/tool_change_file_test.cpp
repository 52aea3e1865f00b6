// [tool_change]: how the machine changes and measures its tools.
#include "machine_text.hpp"
#include <gmock/gmock.h>

#include "passo/interpreter/tool_change_plan.hpp"

namespace passo {
namespace {

const std::string other_axes = R"(
[axis.Y]
steps_per_mm = 100
travel_mm = [-100, 100]
max_velocity_mm_s = 25
max_acceleration_mm_s2 = 200

[axis.Z]
steps_per_mm = 100
travel_mm = [-80, 0]
max_velocity_mm_s = 15
max_acceleration_mm_s2 = 200
)";

const std::string by_hand = R"(
[tool_change]
way = "setter"
safe_z_mm = -2
change_at_mm = [10, -90]
measure_at_mm = [-140, -90]
window_mm = [-70, -20]
seek_mm_s = 10
latch_mm_s = 0.5
)";

const std::string rack = R"(
[tool_change.rack]
pockets = 4
first_mm = [20, 90]
step_mm = [30, 0]
z_mm = -60
entry_mm = [0, -20]
feed_mm_s = 10
opens_with = "flood"
)";

std::optional<MachineDescription> with_change(const std::string& lines, Diagnostics& diagnostics) {
  return parse_machine(sound_machine + other_axes + lines, "m.toml", diagnostics);
}

TEST(ToolChangeFile, is_read) {
  Diagnostics diagnostics;
  const auto machine =
      with_change(by_hand +
                      "lengths = \"absolute\"\nnose_z_mm = -79\nwear_mm = 0.1\nfirst_tool = \"trusted\"\n"
                      "spindle_run_down_s = 4\nretract_mm = 3\ntouches = 4\ntouches_within_mm = 0.02\n",
                  diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  const ToolChangePlan& plan = *machine->tool_change;
  EXPECT_EQ(plan.way, ToolChangeWay::setter);
  EXPECT_EQ(plan.safe_z, -2);
  EXPECT_EQ(plan.change_at, (MachineXy{10, -90}));
  EXPECT_EQ(plan.measure_at, (MachineXy{-140, -90}));
  EXPECT_EQ(plan.window_low, -70);
  EXPECT_EQ(plan.window_high, -20);
  EXPECT_EQ(plan.seek, MmPerSecond(10));
  EXPECT_EQ(plan.latch, MmPerSecond(0.5));
  EXPECT_EQ(plan.retract, 3);
  EXPECT_EQ(plan.touches, 4);
  EXPECT_EQ(plan.agreement, 0.02);
  EXPECT_EQ(plan.use, LengthUse::absolute);
  EXPECT_EQ(plan.setter_z, -79);
  EXPECT_EQ(plan.wear, 0.1);
  EXPECT_EQ(plan.first, FirstTool::trusted);
  EXPECT_EQ(plan.run_down, Seconds(4));
  EXPECT_THAT(describe(*machine), testing::HasSubstr("tool change     by hand, tool setter at X-140 Y-90, touching at "
                                                     "Z-70 to Z-20, across at Z-2; lengths from the nose, Z-79; mean "
                                                     "of 4 touches within 0.02 mm; used tools within 0.1 mm\n"));
}

TEST(ToolChangeFile, is_read_with_a_rack) {
  Diagnostics diagnostics;
  const auto machine = with_change(replaced(by_hand, "\"setter\"", "\"rack\"") + rack, diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  const ToolRack& read = machine->tool_change->rack;
  EXPECT_EQ(read.pockets, 4);
  EXPECT_EQ(read.first, (MachineXy{20, 90}));
  EXPECT_EQ(read.step, (MachineXy{30, 0}));
  EXPECT_EQ(read.entry, (MachineXy{0, -20}));
  EXPECT_EQ(read.z, -60);
  EXPECT_EQ(read.opens, ColletOutput::flood);
  EXPECT_EQ(read.wait, Seconds(1));
  EXPECT_EQ(collet_wait(*machine->tool_change), Seconds(1));
}

TEST(ToolChangeFile, is_read_with_lines_of_a_changer) {
  Diagnostics diagnostics;
  const auto machine =
      with_change(replaced(by_hand, "\"setter\"", "\"macro\"") + "macro = [\"G53 G0 X1\", \"(#5400)\"]\n", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  EXPECT_EQ(machine->tool_change->macro, "G53 G0 X1\n(#5400)\n");
  EXPECT_EQ(collet_wait(*machine->tool_change), Seconds(1));
}

TEST(ToolChangeFile, tells_what_is_wrong) {
  const auto message = [](const std::string& lines) {
    Diagnostics diagnostics;
    EXPECT_FALSE(with_change(lines, diagnostics)) << lines;
    return render(diagnostics, false);
  };
  const auto changed = [&](const char* from, const char* to) { return message(replaced(by_hand, from, to)); };
  using testing::HasSubstr;
  EXPECT_THAT(changed("\"setter\"", "\"magic\""), HasSubstr("\"setter\" or \"plate\" or \"rack\" or \"macro\""));
  EXPECT_THAT(changed("safe_z_mm = -2", "safe_z_mm = 2"), HasSubstr("within Z-80 to Z0"));
  EXPECT_THAT(changed("[-140, -90]", "[-160, -90]"), HasSubstr("outside the travel"));
  EXPECT_THAT(changed("[-70, -20]", "[-20, -70]"), HasSubstr("goes from -20 to -70"));
  EXPECT_THAT(changed("[-70, -20]", "[-70, -3]"), HasSubstr("an upper end of -4 or less"));
  EXPECT_THAT(changed("[-70, -20]", "[-80, -20]"), HasSubstr("needs Z-81, outside the travel"));
  EXPECT_THAT(changed("seek_mm_s = 10", "seek_mm_s = 20"), HasSubstr("15 or less, the velocity of Z"));
  EXPECT_THAT(changed("latch_mm_s = 0.5", "latch_mm_s = 11"), HasSubstr("10 or less, at most the seek speed"));
  EXPECT_THAT(changed("measure_at_mm = [-140, -90]", ""), HasSubstr("[tool_change] lacks measure_at_mm"));
  EXPECT_THAT(message(by_hand + "lengths = \"absolute\"\n"), HasSubstr("lacks nose_z_mm"));
  EXPECT_THAT(message(by_hand + "nose_z_mm = -79\n"), HasSubstr("has no effect with these lengths"));
  EXPECT_THAT(message(by_hand + "touches = 0\n"), HasSubstr("touches"));
  EXPECT_THAT(message(by_hand + "touches = 2.5\n"), HasSubstr("touches"));
  EXPECT_THAT(message(by_hand + "touches_within_mm = 0\n"), HasSubstr("touches_within_mm"));
  EXPECT_THAT(message(by_hand + "first_tool = \"trusted\"\n"), HasSubstr("the first tool has to be measured"));
  EXPECT_THAT(message(by_hand + "measures = false\n"), HasSubstr("M6 then only waits"));
  EXPECT_THAT(message(by_hand + rack), HasSubstr("way = \"rack\""));
  EXPECT_THAT(message(replaced(by_hand, "\"setter\"", "\"rack\"")), HasSubstr("[tool_change.rack]"));
  const std::string plate = replaced(by_hand, "\"setter\"", "\"plate\"");
  EXPECT_THAT(message(plate + "wear_mm = 1\n"), HasSubstr("a used tool is not measured with a touch plate"));
  EXPECT_THAT(message(plate + "lengths = \"absolute\"\nnose_z_mm = 1\n"), HasSubstr("gives no absolute lengths"));
  const std::string with_rack = replaced(by_hand, "\"setter\"", "\"rack\"") + rack;
  EXPECT_THAT(message(replaced(with_rack, "pockets = 4", "pockets = 6")), HasSubstr("the rack needs X170 Y90"));
  EXPECT_THAT(message(replaced(with_rack, "[30, 0]", "[0, 0]")), HasSubstr("all pockets are at the same place"));
  EXPECT_THAT(message(replaced(with_rack, "z_mm = -60", "z_mm = -1")), HasSubstr("not below safe_z_mm"));
  EXPECT_THAT(message(by_hand + "macro = [\"G0 X1\"]\n"), HasSubstr("way = \"macro\""));
  const std::string macro = replaced(by_hand, "\"setter\"", "\"macro\"");
  EXPECT_THAT(message(macro), HasSubstr("lacks macro"));
  EXPECT_THAT(message(by_hand + "collet_wait_s = 1\n"), HasSubstr("collet_wait_s has no effect with this way"));
  EXPECT_THAT(message(macro + "macro = []\n"), HasSubstr("not a list of 1 to 200 lines"));
  EXPECT_THAT(message(macro + "macro = [1]\n"), HasSubstr("has the number 1 in its list"));
  EXPECT_THAT(message(by_hand + "speed = 1\n"), HasSubstr("[machine.unknown-key]"));
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(sound_machine + by_hand, "m.toml", diagnostics));
  EXPECT_THAT(render(diagnostics, false), HasSubstr("[tool_change] needs the axis Y"));
}

}  // namespace
}  // namespace passo
