// A tool change that measures, on a machine whose motion a Grbl board plans: its own probe moves, our tool offsets.
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"
#include <gmock/gmock.h>

#include "passo/interpreter/tool_change_plan.hpp"
#include "passo/sender/grbl_machine_session.hpp"

namespace passo::test {
namespace {

using testing::HasSubstr;

struct ToolChangeOnGrbl : testing::Test {
  ToolChangeOnGrbl() {
    ToolChangePlan plan;
    plan.safe_z = 20;
    plan.measure_at = MachineXy{-30, -25};
    plan.window_low = -40;
    plan.window_high = -5;
    plan.seek = MmPerSecond(25);
    plan.latch = MmPerSecond(2);
    plan.retract = 1;
    MachineDescription machine = example_machine("router");
    machine.tool_change = std::make_shared<const ToolChangePlan>(plan);
    run.emplace(machine, [this](StrictGrbl& grbl) {
      grbl.probe = [this](const Point& place) {
        const bool is_over_setter = std::abs(place[Axis::x] + 30) < 5 && std::abs(place[Axis::y] + 25) < 5;
        return closed || (is_over_setter && place[Axis::z] <= (tool == 1 ? -20 : -12.5));
      };
    });
  }
  void fit(int next) {
    ASSERT_TRUE(run->play_until(MachineState::tool_change));
    EXPECT_EQ(run->session.status().waits_for->tool, next);
    EXPECT_NEAR(run->grbl.place()[Axis::z], 20, 1e-6);
    tool = next;
    ASSERT_TRUE(run->ask(request::OperatorDone{}));
    run->play_for(Seconds(0.2));
  }

  int tool = 0;
  bool closed = false;
  std::optional<GrblSessionRun> run;
};

TEST_F(ToolChangeOnGrbl, measures_and_goes_on_with_the_length) {
  ASSERT_TRUE(run->go_online());
  request::Start start = grbl_start("G21 G90\nG1 X5 F1200\nT1 M6\nT2 M6\nG0 Z3\nG1 X9 Z2 F600\nM2\n");
  start.options.dialect = Dialect::linuxcnc;
  const auto ticket = run->ask(std::move(start));
  ASSERT_TRUE(ticket);
  fit(1);
  fit(2);
  ASSERT_TRUE(run->play([&] { return run->grbl.place()[Axis::x] > 7; }));
  const auto zero = run->session.status().executes.work_zero;
  ASSERT_TRUE(zero);
  EXPECT_NEAR((*zero)[Axis::z], 7.5, 0.02) << "positions are shown with the length";
  ASSERT_TRUE(run->play([&] { return run->answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run->answer_to(*ticket)->outcome, Outcome::done) << run->session.trouble_words();
  EXPECT_NEAR(run->grbl.place()[Axis::x], 9, 1e-3);
  EXPECT_NEAR(run->grbl.place()[Axis::z], 2 + 7.5, 0.02);
}

TEST_F(ToolChangeOnGrbl, asks_again_if_the_setter_is_closed) {
  ASSERT_TRUE(run->go_online());
  closed = true;
  request::Start start = grbl_start("G21 G90\nT1 M6\nG0 Z3\nM2\n");
  start.options.dialect = Dialect::linuxcnc;
  const auto ticket = run->ask(std::move(start));
  ASSERT_TRUE(ticket);
  fit(1);
  ASSERT_TRUE(run->play_until(MachineState::tool_change));
  EXPECT_THAT(run->session.status().waits_for->words, HasSubstr("the tool setter is closed already"));
  closed = false;
  fit(1);
  ASSERT_TRUE(run->play([&] { return run->answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run->answer_to(*ticket)->outcome, Outcome::done) << run->session.trouble_words();
  EXPECT_NEAR(run->grbl.place()[Axis::z], 3, 0.02);
}

}  // namespace
}  // namespace passo::test
