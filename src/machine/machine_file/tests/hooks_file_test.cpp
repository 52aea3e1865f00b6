// [hooks]: lines of G-code at the start and at the end of each job.
#include "machine_text.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using testing::HasSubstr;

TEST(HooksFile, are_read) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(
      sound_machine + "[hooks]\nat_start = [\"M8\", \"G4 P2\"]\nat_end = [\"G53 G0 X-1\"]\n", "m.toml", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, false);
  EXPECT_EQ(machine->hooks.at_start, "M8\nG4 P2\n");
  EXPECT_EQ(machine->hooks.at_end, "G53 G0 X-1\n");
  EXPECT_THAT(describe(*machine), HasSubstr("lines of G-code in each job: 2 at the start, 1 at the end"));
}

TEST(HooksFile, tell_what_is_wrong) {
  const auto message = [](const std::string& lines) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_machine(sound_machine + "[hooks]\n" + lines, "m.toml", diagnostics)) << lines;
    return render(diagnostics, false);
  };
  EXPECT_THAT(message("at_start = \"M8\"\n"), HasSubstr("hooks.at_start is not a list of 1 to 200 lines"));
  EXPECT_THAT(message("at_end = []\n"), HasSubstr("hooks.at_end is not a list of 1 to 200 lines"));
  EXPECT_THAT(message("at_end = [1]\n"), HasSubstr("hooks.at_end has the number 1 in its list"));
  EXPECT_THAT(message("at_hold = [\"M9\"]\n"), HasSubstr("[machine.unknown-key]"));
}

}  // namespace
}  // namespace passo
