#include "machine_text.hpp"

namespace passo {
namespace {

TEST(Describe, tells_a_machine_as_a_person_reads_it) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(sound_machine, "m.toml", diagnostics);
  ASSERT_TRUE(machine);
  EXPECT_EQ(describe(*machine),
            "machine         Test machine\n"
            "path tolerance  0.02 mm, 0.05 deg\n"
            "board           clock 16000000 Hz, 244.1 to 50000 events/s, step pulse 2.5 us\n"
            "tool            Spindle, up to 10000 rpm, 3 mm\n"
            "axis X          motor 0, 100 steps/mm, 0.01 mm/step, -150 to 150 mm, 25 mm/s (2500 steps/s), "
            "200 mm/s2\n"
            "axis A          motor 1, 160 steps/deg, 0.00625 deg/step, -180 to 180 deg, 60 deg/s (9600 steps/s), "
            "300 deg/s2, inverted\n");
}

TEST(Describe, calls_a_tool_without_speed_a_relay) {
  MachineDescription machine;
  machine.name = "Bare";
  EXPECT_THAT(describe(machine), testing::HasSubstr("tool            without a name, a relay (on or off)\n"));
}

}  // namespace
}  // namespace passo
