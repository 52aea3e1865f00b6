// [handwheel]: a handwheel at pins of the board.
#include "machine_text.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

// The sound machine has the axes X and A.
std::optional<MachineDescription> with_handwheel(const std::string& lines, Diagnostics& diagnostics) {
  return parse_machine(std::string(sound_machine) + "\n[handwheel]\n" + lines, "m.toml", diagnostics);
}

TEST(HandwheelFile, has_usual_values) {
  Diagnostics diagnostics;
  const auto machine = with_handwheel("", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  ASSERT_TRUE(machine->handwheel);
  const HandwheelDescription& wheel = *machine->handwheel;
  EXPECT_EQ(wheel.axes[0], machine->axes[0].axis);
  EXPECT_EQ(wheel.axes[1], machine->axes[1].axis);
  EXPECT_FALSE(wheel.axes[3]);
  EXPECT_EQ(wheel.counts_per_detent, 4);
  EXPECT_EQ(wheel.step, 0.01);
  EXPECT_EQ(wheel.share, 0.5);
  EXPECT_FALSE(wheel.is_reversed);
  EXPECT_GT(wheel.place.line, 1U);
  EXPECT_FALSE(parse_machine(sound_machine, "m.toml", diagnostics)->handwheel);
}

TEST(HandwheelFile, is_read) {
  Diagnostics diagnostics;
  const auto machine = with_handwheel(
      "axes = \"-AX\"\ncounts_per_detent = 2\nstep_mm = 0.001\nspeed_percent = 20\nreversed = true\n", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  const HandwheelDescription& wheel = *machine->handwheel;
  EXPECT_FALSE(wheel.axes[0]);
  EXPECT_EQ(wheel.axes[1], Axis::a);
  EXPECT_EQ(wheel.axes[2], Axis::x);
  EXPECT_EQ(wheel.counts_per_detent, 2);
  EXPECT_EQ(wheel.step, 0.001);
  EXPECT_EQ(wheel.share, 0.2);
  EXPECT_TRUE(wheel.is_reversed);
  EXPECT_THAT(describe(*machine),
              testing::HasSubstr("handwheel       axes -AX-, 0.001 mm or degrees for 2 counts, times 1, 10 and 100; up "
                                 "to 20 %, reversed\n"));
}

TEST(HandwheelFile, tells_what_is_wrong) {
  const auto findings = [](const std::string& lines) {
    Diagnostics diagnostics;
    EXPECT_FALSE(with_handwheel(lines, diagnostics)) << lines;
    return render(diagnostics, false);
  };
  for (const char* axes : {"XX", "Q", "XAXAX", "", "x"}) {
    const std::string text = findings("axes = \"" + std::string(axes) + "\"\n");
    EXPECT_THAT(text, testing::HasSubstr("[machine.handwheel]"));
    EXPECT_THAT(text, testing::HasSubstr("m.toml:"));
  }
  EXPECT_THAT(findings("counts_per_detent = 0\n"), testing::HasSubstr("[machine.out-of-range]"));
  EXPECT_THAT(findings("step_mm = 5\n"), testing::HasSubstr("[machine.out-of-range]"));
  EXPECT_THAT(findings("speed = 5\n"), testing::HasSubstr("perhaps speed_percent"));
}

}  // namespace
}  // namespace passo
