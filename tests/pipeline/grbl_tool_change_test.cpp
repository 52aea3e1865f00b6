// M6 of a sender, in Grbl's dialect, on a machine that measures its tools. The sender reads the messages, and continues
// with `~`.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "grbl_kit.hpp"
#include <gmock/gmock.h>

#include "passo/interpreter/tool_change_plan.hpp"

namespace passo::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

MachineDescription measuring_router() {
  ToolChangePlan plan;
  plan.safe_z = 20;
  plan.change_at = MachineXy{10, 0};
  plan.measure_at = MachineXy{-10, -5};
  plan.window_low = -8;
  plan.window_high = 5;
  plan.seek = MmPerSecond(25);
  plan.latch = MmPerSecond(2);
  plan.retract = 1;
  plan.use = LengthUse::absolute;
  plan.setter_z = -6;
  MachineDescription machine = example_machine("router");
  machine.tool_change = std::make_shared<const ToolChangePlan>(plan);
  return machine;
}

std::vector<Touchable> setter(double z) {
  TouchBox box;
  box.ranges[Axis::x] = {-12, -8};
  box.ranges[Axis::z].high = z;
  return {box};
}

constexpr KnownPosition homed{.place = Point(), .trust = Trust::homed};

struct GrblToolChange : testing::Test {
  // The lines that came until the sender waits again, or nothing came for a second.
  std::vector<std::string> heard(GrblRun& run) {
    run.pass(Seconds(20));
    std::vector<std::string> lines(run.replies.begin(), run.replies.end());
    run.replies.clear();
    return lines;
  }
  double z(GrblRun& run) { return run.session().status().now_at[Axis::z]; }
};

TEST_F(GrblToolChange, asks_measures_after_a_cycle_start_and_goes_on) {
  GrblRun run(measuring_router(), homed, setter(-4));
  run.reply();
  run.send("G21 G90\nM3 S1000\nT1 M6\nG0 X1 Z3\n");
  const auto asked = heard(run);
  EXPECT_THAT(asked, Contains("[MSG:Tool 1]"));
  EXPECT_THAT(asked, Contains("[MSG:put tool 1 into the spindle, then continue]"));
  EXPECT_TRUE(run.is("Hold:0")) << run.status();
  EXPECT_EQ(z(run), 20);
  EXPECT_EQ(run.board().counts().outputs.switches, 0) << "the spindle stands";
  run.send("~");
  const auto done = heard(run);
  EXPECT_EQ(std::ranges::count(done, "ok") + std::ranges::count(asked, "ok"), 4);
  EXPECT_TRUE(run.is("Idle")) << run.status();
  EXPECT_NEAR(z(run), 5, 0.01);  // Z3 with a tool that is 2 mm long
  run.send("$#\n");
  EXPECT_THAT(heard(run), Contains("[TLO:2.000]"));
}

TEST_F(GrblToolChange, is_held_and_ended_by_a_reset_with_the_tool_up) {
  GrblRun run(measuring_router(), homed, setter(-4));
  run.reply();
  run.send("T1 M6\nG0 Z3\n");
  heard(run);
  run.send("~");
  ASSERT_TRUE(run.turn_until([&] { return z(run) < 10; }, Seconds(20)));
  run.send("!");
  heard(run);
  EXPECT_TRUE(run.is("Hold:0")) << run.status();
  const double held = z(run);
  EXPECT_GT(held, -4);
  run.send("~");
  heard(run);
  EXPECT_TRUE(run.is("Idle")) << run.status();
  EXPECT_NEAR(z(run), 5, 0.01);
  run.send("T2 M6\n");
  heard(run);
  EXPECT_TRUE(run.is("Hold:0")) << run.status();
  run.send("\x18");
  heard(run);
  EXPECT_NEAR(z(run), 20, 1e-6);
  run.send("T2 M6\n");  // as at first
  EXPECT_THAT(heard(run), Contains("[MSG:Tool 2]"));
}

TEST_F(GrblToolChange, names_the_reason_if_the_setter_is_closed_and_asks_again) {
  GrblRun run(measuring_router(), homed, setter(30));
  run.reply();
  run.send("T1 M6\nG0 Z3\n");
  heard(run);
  run.send("~");
  const auto again = heard(run);
  EXPECT_THAT(again, Contains(HasSubstr("[MSG:the tool setter is closed already")));
  EXPECT_THAT(again, Contains("[MSG:Tool 1]"));
  EXPECT_TRUE(run.is("Hold:0")) << run.status();
  EXPECT_EQ(z(run), 20);
}

TEST_F(GrblToolChange, is_refused_where_the_position_is_not_known) {
  GrblRun run(measuring_router(), {.place = Point(), .trust = Trust::unknown}, setter(-4));
  run.reply();
  heard(run);
  run.send("$X\n");
  heard(run);
  run.send("T1 M6\n");
  EXPECT_THAT(heard(run), Contains("[MSG:Tool 1]")) << "confirmed by $X";
}

}  // namespace
}  // namespace passo::test
