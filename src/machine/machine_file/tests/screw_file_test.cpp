#include "machine_text.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

std::string with_screw(std::string_view lines) {
  return sound_machine + "[axis.X.screw]\n" + std::string(lines);
}

TEST(ScrewFile, tells_backlash_and_errors_of_pitch) {
  Diagnostics diagnostics;
  const auto machine =
      parse_machine(with_screw("backlash_mm = 0.15\nerror_mm = [[-100, 0.0], [0, 0.012], [100, -0.004]]\n"
                               "[axis.A.screw]\nbacklash_deg = 0.1\ncompensate = false\n"),
                    "m.toml", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  const ScrewDescription& x = *machine->axes[0].screw;
  EXPECT_EQ(x.backlash, 0.15);
  EXPECT_TRUE(x.is_compensated);
  ASSERT_EQ(x.errors.size(), 3U);
  EXPECT_EQ(x.errors[1].at, 0);
  EXPECT_EQ(x.errors[1].off, 0.012);
  const ScrewDescription& a = *machine->axes[1].screw;
  EXPECT_EQ(a.backlash, 0.1);
  EXPECT_TRUE(a.errors.empty());
  EXPECT_FALSE(a.is_compensated);
  EXPECT_THAT(describe(*machine),
              testing::HasSubstr("screw with 0.15 mm of backlash, errors at 3 places, compensated\n"));
  EXPECT_THAT(describe(*machine), testing::HasSubstr("screw with 0.1 deg of backlash, not compensated\n"));
}

TEST(ScrewFile, refuses_what_no_screw_does) {
  const auto first_of = [](std::string_view lines) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_machine(with_screw(lines), "m.toml", diagnostics)) << lines;
    const Diagnostic& first = diagnostics.all().at(0);
    return fmt::format("{} {}", first.place.line - 28, first.code);
  };
  EXPECT_EQ(first_of("backlash_mm = -0.1\n"), "1 machine.out-of-range");
  EXPECT_EQ(first_of("error_mm = [[0, 0], [0, 0.01]]\n"), "1 machine.screw");
  EXPECT_EQ(first_of("error_mm = [[10, 0], [0, 0.01]]\n"), "1 machine.screw");
  EXPECT_EQ(first_of("error_mm = [[0, 0], [10, 0.1]]\n"), "1 machine.screw") << "1 %";
  EXPECT_EQ(first_of("error_mm = [[0, 0], [10]]\n"), "1 machine.wrong-type");
  EXPECT_EQ(first_of("backlash_deg = 0.1\n"), "1 machine.unknown-key");
}

}  // namespace
}  // namespace passo
