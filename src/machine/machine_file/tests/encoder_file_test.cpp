// [axis.X.encoder]: the encoder on the motor of an axis.
#include "machine_text.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

std::optional<MachineDescription> with_encoder(const std::string& lines, Diagnostics& diagnostics) {
  return parse_machine(replaced(sound_machine, "[axis.A]", "[axis.X.encoder]\n" + lines + "[axis.A]"), "m.toml",
                       diagnostics);
}

TEST(EncoderFile, is_read_with_its_limit) {
  Diagnostics diagnostics;
  const auto machine =
      with_encoder("counts_per_turn = 4000\nmost_following_error_mm = 0.5\nclosed_loop = true\n", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  ASSERT_TRUE(machine->axes[0].encoder);
  EXPECT_EQ(machine->axes[0].encoder->counts_per_turn, 4000);
  EXPECT_EQ(machine->axes[0].encoder->most_error, 0.5);
  EXPECT_TRUE(machine->axes[0].encoder->closes_loop);
  EXPECT_FALSE(machine->axes[1].encoder);
  EXPECT_THAT(describe(*machine),
              testing::HasSubstr("encoder with 4000 counts a turn, at most 0.5 mm behind, closed loop\n"));
}

TEST(EncoderFile, only_measures_unless_told_otherwise) {
  Diagnostics diagnostics;
  const auto machine = with_encoder("counts_per_turn = 400\n", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  EXPECT_EQ(machine->axes[0].encoder->most_error, 0);
  EXPECT_FALSE(machine->axes[0].encoder->closes_loop);
}

TEST(EncoderFile, tells_what_is_wrong) {
  const auto describe = [](const std::string& lines) {
    Diagnostics diagnostics;
    EXPECT_FALSE(with_encoder(lines, diagnostics));
    return render(diagnostics, false);
  };
  EXPECT_THAT(describe("closed_loop = true\n"), testing::HasSubstr("[axis.X.encoder] lacks counts_per_turn"));
  EXPECT_THAT(describe("counts_per_turn = 2\n"), testing::HasSubstr("[machine.out-of-range]"));
  EXPECT_THAT(describe("counts_per_turn = 400\nmost_following_error_deg = 1\n"),
              testing::HasSubstr("perhaps most_following_error_mm"));
}

}  // namespace
}  // namespace passo
