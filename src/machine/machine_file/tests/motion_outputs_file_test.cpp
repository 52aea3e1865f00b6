#include "machine_text.hpp"

namespace passo {
namespace {

std::string first_code(const std::string& text) {
  Diagnostics diagnostics;
  if (parse_machine(sound_machine + text, "m.toml", diagnostics)) return "";
  return diagnostics.all().empty() ? "none" : diagnostics.all()[0].code;
}

TEST(MotionOutputsFile, gives_the_digital_outputs_and_the_laser) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(sound_machine +
                                         "[output.0]\npin = \"flood\"\n[output.2]\npin = \"mist\"\non_stop = \"keep\"\n"
                                         "[laser]\nmaximum_s = 255\nminimum_percent = 2\n",
                                     "m.toml", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  const MotionOutputsDescription& outputs = machine->motion_outputs;
  ASSERT_TRUE(outputs.digital[0] && outputs.digital[2] && outputs.laser);
  EXPECT_FALSE(outputs.digital[1]);
  EXPECT_EQ(outputs.digital[0]->pin, DigitalOutputDescription::Pin::flood);
  EXPECT_FALSE(outputs.digital[0]->stays_on);
  EXPECT_EQ(outputs.digital[2]->pin, DigitalOutputDescription::Pin::mist);
  EXPECT_TRUE(outputs.digital[2]->stays_on);
  EXPECT_EQ(outputs.laser->maximum_s, 255);
  EXPECT_EQ(outputs.laser->minimum, 0.02);
  const std::string text = describe(*machine);
  EXPECT_NE(text.find("output 0        flood, off in stops\n"), std::string::npos) << text;
  EXPECT_NE(text.find("output 2        mist, kept in stops\n"), std::string::npos) << text;
  EXPECT_NE(text.find("laser           full power at S255, at least 2 %\n"), std::string::npos) << text;
}

TEST(MotionOutputsFile, are_optional) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(sound_machine, "m.toml", diagnostics);
  ASSERT_TRUE(machine);
  EXPECT_FALSE(machine->motion_outputs.laser);
  EXPECT_EQ(describe(*machine).find("laser"), std::string::npos);
}

TEST(MotionOutputsFile, must_name_outputs_of_a_board) {
  EXPECT_EQ(first_code("[output.1]\npin = \"spindle_direction\"\n"), "");
  EXPECT_EQ(first_code("[output.0]\n"), "machine.missing-key");
  EXPECT_EQ(first_code("[output.0]\npin = \"D11\"\n"), "machine.output");
  EXPECT_EQ(first_code("[output.3]\npin = \"mist\"\n"), "machine.output");
  EXPECT_EQ(first_code("[output]\npin = \"mist\"\n"), "machine.output");
  EXPECT_EQ(first_code("[output.0]\npin = \"mist\"\non_stop = \"on\"\n"), "machine.output");
  EXPECT_EQ(first_code("[output.0]\npin = \"mist\"\nat_stop = \"off\"\n"), "machine.unknown-key");
  EXPECT_EQ(first_code("[output.0]\npin = \"mist\"\n[output.1]\npin = \"mist\"\n"), "machine.output");
  EXPECT_EQ(first_code("[laser]\n"), "machine.missing-key");
  EXPECT_EQ(first_code("[laser]\nmaximum_s = 0\n"), "machine.out-of-range");
  EXPECT_EQ(first_code("[laser]\nmaximum_s = 1000\nminimum_percent = 101\n"), "machine.out-of-range");
}

}  // namespace
}  // namespace passo
