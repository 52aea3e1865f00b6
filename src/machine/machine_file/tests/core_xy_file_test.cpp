#include "machine_text.hpp"

namespace passo {
namespace {

const std::string with_y = sound_machine + R"(
[axis.Y]
steps_per_mm = 100
travel_mm = [0, 200]
max_velocity_mm_s = 25
max_acceleration_mm_s2 = 200
)";

std::string core_xy(const std::string& text) {
  return replaced(text, "path_tolerance_mm", "kinematics = \"corexy\"\npath_tolerance_mm");
}

std::string messages_of(const std::string& text, MachineUse use = MachineUse::any_board) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(text, "m.toml", diagnostics, use);
  EXPECT_EQ(machine.has_value(), !diagnostics.any_error());
  return machine ? std::string() : render(diagnostics, false);
}

TEST(CoreXyFile, describes_a_machine_for_a_board_with_grbl) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(core_xy(with_y), "m.toml", diagnostics, MachineUse::any_board);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  EXPECT_TRUE(machine->is_core_xy);
  EXPECT_NE(describe(*machine).find("CoreXY: X and Y share two motors"), std::string::npos);
  const auto plain = parse_machine(replaced(core_xy(with_y), "corexy", "cartesian"), "m.toml", diagnostics);
  ASSERT_TRUE(plain);
  EXPECT_FALSE(plain->is_core_xy);
}

TEST(CoreXyFile, is_refused_by_whoever_plans_the_motors) {
  const std::string messages = messages_of(core_xy(with_y), MachineUse::own_board);
  EXPECT_NE(messages.find("m.toml:2:14: error: the boards of Passo"), std::string::npos) << messages;
  EXPECT_NE(messages.find("[machine.kinematics]"), std::string::npos);
  EXPECT_NE(messages.find("--board grbl"), std::string::npos);
}

TEST(CoreXyFile, is_refused_where_its_motors_cannot_be_shared) {
  EXPECT_EQ(messages_of(core_xy(with_y)), "");
  const auto refuses = [](const std::string& text, const char* words) {
    const std::string messages = messages_of(text);
    EXPECT_NE(messages.find(words), std::string::npos) << words << "\n" << messages;
    EXPECT_NE(messages.find("[machine.kinematics]"), std::string::npos) << messages;
  };
  refuses(replaced(core_xy(with_y), "corexy", "delta"), "kinematics = \"delta\"");
  refuses(core_xy(sound_machine), "a CoreXY has the axes X and Y");
  refuses(core_xy(replaced(with_y, "[axis.Y]\nsteps_per_mm = 100", "[axis.Y]\nsteps_per_mm = 80")),
          "X has 100 steps per mm and Y has 80");
  refuses(core_xy(with_y + "[axis.Y.screw]\nbacklash_mm = 0.1\n"), "[axis.Y.screw] describes a motor of its own");
}

}  // namespace
}  // namespace passo
