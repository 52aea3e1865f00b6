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

}  // namespace
