// Tool changes that measure, as a user sees them: an example machine for each way, and docs/manual/tool-changes.md.
#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::checkout;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;

class ToolChanges : public passo::test::CommandLine {
 protected:
  static std::string machine(const std::string& name) { return checkout + "/examples/machines/" + name + ".toml"; }
  const std::string job_ = checkout + "/examples/tool-change.ngc";
};

TEST_F(ToolChanges, run_on_an_example_machine_of_each_way) {
  struct Way {
    std::string machine;
    std::string touches;
    unsigned probes;
    std::string described;
  };
  // Two tools with two touches each; with wear_mm, both used tools again.
  for (const Way& way : {Way{"tool-setter", "", 8, "by hand, tool setter at X380 Y-280"},
                         Way{"touch-plate", " --touch Z:-20", 4, "by hand, touch plate at the work's X0 Y0"},
                         Way{"tool-rack", "", 8, "rack of 6 at X380 Y-280"},
                         Way{"tool-changer", "", 4, "by lines of G-code at X380 Y-280"}}) {
    SCOPED_TRACE(way.machine);
    EXPECT_THAT(passo("machine " + machine(way.machine)).out, HasSubstr(way.described));
    const Outcome check = passo("check " + job_ + " -m " + machine(way.machine) + " --json");
    ASSERT_EQ(check.code, 0) << check.err;
    const Outcome run = passo("run " + job_ + " -m " + machine(way.machine) + way.touches + " --json --yes");
    ASSERT_EQ(run.code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["probes"]["touched"], way.probes);
    // The check counts the ways down to the lower end of the window, the run those to the tool.
    const auto checked = nlohmann::json::parse(check.out);
    EXPECT_EQ(checked["tool_changes"], 2 + (way.machine == "tool-rack" ? 1 : 0));
    EXPECT_GT(checked["time_s"], 60);
  }
}

TEST_F(ToolChanges, are_checked_against_the_travel_with_each_job) {
  const std::string text = read(machine("tool-setter"));
  const std::string wrong = write("m.toml", std::string(text).replace(text.find("[380, -280]"), 11, "[480, -280]"));
  const Outcome outcome = passo("check " + job_ + " -m " + wrong);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("tool_change.measure_at_mm is [480, -280], outside the travel"));
}

TEST_F(ToolChanges, end_with_the_reason_if_nothing_touches) {
  const Outcome outcome = passo("run " + job_ + " -m " + machine("tool-setter") + " --touch X0:1,Y0:1,Z:-119 --yes");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("gcode.tool-not-measured"));
  EXPECT_THAT(outcome.err, HasSubstr("tool 1 touched nothing down to Z-100.000"));
  EXPECT_THAT(outcome.err, HasSubstr("stopped at X380.000 Y-280.000 Z50.000"));
}

// The probe input of the emulated chip is the tool setter or the touch plate, and its firmware captures the contacts.
// The ways are short, because an emulated chip is slow.
std::string with_a_change_nearby(const std::string& machine, const std::string& way) {
  std::string text = read(checkout + "/examples/machines/" + machine + ".toml");
  const std::size_t rate = text.find("150_000");  // events a second: too many for a Mega
  if (rate != std::string::npos) text.replace(rate, 7, "100_000");
  return text + "\n[tool_change]\n" + way +
         "safe_z_mm = 0.5\nwindow_mm = [-3, -0.1]\nseek_mm_s = 10\nlatch_mm_s = 2\nretract_mm = 0.2\n";
}
const std::string setter_nearby =
    "way = 'setter'\nchange_at_mm = [0, 0.5]\nmeasure_at_mm = [1, 0]\nwear_mm = 0.1\n"
    "lengths = 'absolute'\nnose_z_mm = -1\n";
const std::string plate_nearby = "way = 'plate'\nchange_at_mm = [0.5, 0.5]\nlengths = 'work'\n";

// The plate lies at the work's X0: 0.3 mm lower for the second tool.
TEST_F(ToolChanges, are_the_same_on_emulated_boards) {
  struct Change {
    std::string board;
    std::string machine;
    std::string way;
    int touches;
    int z_steps;
  };
  const std::string program = write("p.ngc", "G21 G90\nT1 M6\nG0 X1 Z0\nG10 L2 P1 X2\nT2 M6\nG0 X-1 Z0\nM2\n");
  for (const Change& one : {Change{"sim:uno", "uno", setter_nearby, 8, 640 / 2},
                            {"sim:uno", "uno", plate_nearby, 4, -640 * 3 / 10},
                            {"sim:mega", "uno", setter_nearby, 8, 640 / 2},
                            {"sim:mega", "uno", plate_nearby, 4, -640 * 3 / 10},
                            {"sim:pico", "pico", setter_nearby, 8, 640 / 2}}) {
    SCOPED_TRACE(one.board + " " + one.way);
    const std::string run = "run " + program +
                            " --json --yes --from-here --touch X:1.5,Z:-0.5 --touch X1.5:,Z:-0.8 -m " +
                            write("m.toml", with_a_change_nearby(one.machine, one.way));
    const Outcome alone = passo(run);
    ASSERT_EQ(alone.code, 0) << alone.err;
    const auto expected = nlohmann::json::parse(alone.out);
    const Outcome emulated = passo(run + " --board " + one.board);
    if (passo::test::lacks_an_emulator(emulated)) continue;
    ASSERT_EQ(emulated.code, 0) << emulated.err;
    const auto json = nlohmann::json::parse(emulated.out);
    EXPECT_EQ(json["probes"]["touched"], one.touches) << "with wear_mm the used tools, too";
    EXPECT_EQ(json["probes"]["last_contact_mm"], expected["probes"]["last_contact_mm"]);
    EXPECT_EQ(json["steps"]["X"]["net"], 640);
    EXPECT_EQ(json["steps"]["Y"]["net"], 0);
    EXPECT_EQ(json["steps"]["Z"]["net"], one.z_steps) << "Z0 with the length that was found";
  }
}

TEST_F(ToolChanges, end_on_an_emulated_board_if_the_setter_is_closed_already) {
  const std::string program = write("p.ngc", "G21 G90\nT1 M6\nM2\n");
  const std::string machine = write("m.toml", with_a_change_nearby("uno", setter_nearby));
  const Outcome outcome =
      passo("run " + program + " --yes --from-here -m " + machine + " --touch X0.9:2 --board sim:uno");
  if (passo::test::lacks_an_emulator(outcome)) GTEST_SKIP() << outcome.err;
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("gcode.tool-not-measured"));
  EXPECT_THAT(outcome.err, HasSubstr("the tool setter is closed already"));
}

}  // namespace
