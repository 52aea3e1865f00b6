// A sender on a machine whose motion a Grbl board plans: the settings that it reads and writes are the board's, and its
// M6 measures the tool by the board's probe moves.
#include <memory>
#include <string>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"
#include <gmock/gmock.h>

#include "passo/grbl/grbl_controller.hpp"
#include "passo/interpreter/tool_change_plan.hpp"

namespace passo::test {
namespace {

using testing::HasSubstr;

class GrblBoardSender : public testing::Test {
 protected:
  explicit GrblBoardSender(const MachineDescription& machine = example_machine("router")) : run(machine) {
    EXPECT_TRUE(run.go_online());
    options_.dialect = Dialect::grbl;
    program_.emplace(run.description, options_, Point());
    grbl_.emplace(run.description, run.session, *program_);
    said();
  }
  // What the controller has said until the line is answered.
  std::string ask(const std::string& line, Seconds most = Seconds(30)) {
    grbl_->receive(line + "\n");
    std::string all;
    for (const Seconds end = run.session.now() + most; run.session.now() < end;) {
      turn();
      all += said();
      if (all.ends_with("ok\r\n") || all.find("error:") != std::string::npos) break;
    }
    return all;
  }
  void turn() {
    run.session.poll(Seconds(0.01));
    grbl_->poll(run.session.take_changes());
  }
  // Whether the machine comes to rest there, and the session has heard of it.
  bool settles_at(double x, double y) {
    for (int i = 0; i < 2000; ++i) {
      turn();
      const Point at = run.grbl.place();
      const bool is_there = std::abs(at[Axis::x] - x) < 5e-3 && std::abs(at[Axis::y] - y) < 5e-3;
      if (!is_there || run.grbl.state != "Idle") continue;
      for (int k = 0; k < 60; ++k) turn();
      return true;
    }
    return false;
  }
  std::string said() {
    std::string all;
    for (const std::string& text : grbl_->take_replies()) all += text;
    return all;
  }

  GrblSessionRun run;
  InterpreterOptions options_;
  std::optional<StreamedProgram> program_;
  std::optional<GrblController> grbl_;
};

TEST_F(GrblBoardSender, reads_the_settings_as_the_board_writes_them) {
  const std::string all = ask("$$");
  EXPECT_THAT(all, HasSubstr("$11=0.010\r\n"));
  EXPECT_THAT(all, HasSubstr("$26=250\r\n"));
  EXPECT_THAT(all, HasSubstr("$110=3000.000\r\n"));
  EXPECT_THAT(all, HasSubstr("$10=3\r\n")) << "the sender's reports are ours";
  EXPECT_THAT(ask("$ES"), HasSubstr("[SETTING:110|43|Maximum rate of X|mm/min|6|#####0.000|0.001||0|0]"));
}

TEST_F(GrblBoardSender, writes_a_setting_through_and_has_it_read_back) {
  EXPECT_EQ(ask("$110=2500"), "ok\r\n");
  EXPECT_EQ(run.grbl.values()[110], 2500);
  EXPECT_THAT(ask("$$"), HasSubstr("$110=2500.000\r\n"));
  EXPECT_EQ(run.session.board().settings.at(110), 2500);
  // After lines, too, whose stream is still open.
  EXPECT_EQ(ask("G1 X1 F1000"), "ok\r\n");
  for (int i = 0; i < 100; ++i) turn();
  EXPECT_EQ(ask("$111=2000"), "ok\r\n");
  EXPECT_EQ(run.grbl.values()[111], 2000);
  EXPECT_EQ(ask("G1 X2"), "ok\r\n") << "the sender goes on";
}

TEST_F(GrblBoardSender, hears_why_a_value_was_not_written) {
  const std::string refused = ask("$20=1");  // without homing
  EXPECT_THAT(refused, HasSubstr("[MSG:"));
  EXPECT_THAT(refused, HasSubstr("error:3"));
  EXPECT_EQ(run.grbl.values()[20], 0);
  EXPECT_EQ(ask("$99=1"), "error:3\r\n") << "a setting that the board does not have";
  EXPECT_EQ(ask("$110=-1"), "error:4\r\n");
  EXPECT_EQ(ask("$110=fast"), "error:2\r\n");
}

TEST_F(GrblBoardSender, that_writes_back_what_it_has_read_writes_nothing) {
  const std::size_t before = run.port.sent.size();
  EXPECT_EQ(ask("$110=3000.000"), "ok\r\n");
  EXPECT_EQ(ask("$11=0.01"), "ok\r\n");
  EXPECT_EQ(run.port.sent.find("$110", before), std::string::npos);
  EXPECT_EQ(ask("$10=1"), "ok\r\n");
  EXPECT_EQ(run.port.sent.find("$10=", before), std::string::npos);
  EXPECT_THAT(ask("$$"), HasSubstr("$10=1\r\n"));
}

TEST_F(GrblBoardSender, gets_no_setting_while_the_machine_moves) {
  EXPECT_EQ(ask("G1 X50 F600"), "ok\r\n");
  turn();
  EXPECT_EQ(ask("$110=2500"), "error:8\r\n");
  EXPECT_EQ(run.grbl.values()[110], 3000);
  EXPECT_TRUE(settles_at(50, 0));
}

TEST_F(GrblBoardSender, that_resets_in_between_gets_one_banner_and_the_value_is_whole) {
  grbl_->receive("$110=2500\n");
  turn();
  grbl_->receive("\x18");
  std::string all;
  for (int i = 0; i < 400; ++i) {
    turn();
    all += said();
  }
  EXPECT_THAT(all, HasSubstr("Grbl 1.1h"));
  EXPECT_EQ(all.find("ok\r\n"), std::string::npos) << "the answer was dropped by the reset";
  const double value = run.grbl.values()[110];
  EXPECT_TRUE(value == 2500 || value == 3000) << value;
  EXPECT_EQ(ask("$110=2600"), "ok\r\n");
}

TEST_F(GrblBoardSender, goes_on_from_where_a_pendant_has_left_the_machine) {
  EXPECT_EQ(ask("G1 X10 F1200"), "ok\r\n");
  ASSERT_TRUE(settles_at(10, 0));
  run.grbl.receive("$J=G91Y5F1000\n");
  ASSERT_TRUE(settles_at(10, 5));
  run.grbl.receive("G91G20\nG0X0.1\n");  // other modes, too
  ASSERT_TRUE(settles_at(12.54, 5));
  EXPECT_EQ(ask("G1 X20"), "ok\r\n");
  ASSERT_TRUE(settles_at(20, 5)) << run.session.trouble_words();
  EXPECT_EQ(ask("G91 G1 X1"), "ok\r\n");
  ASSERT_TRUE(settles_at(21, 5)) << run.session.trouble_words();
  EXPECT_EQ(run.session.trouble_words(), "");
}

// The line was interpreted from where the machine stood before.
TEST_F(GrblBoardSender, goes_back_first_if_the_line_came_before_the_pendant_had_moved) {
  EXPECT_EQ(ask("G1 X10 F1200"), "ok\r\n");
  ASSERT_TRUE(settles_at(10, 0));
  run.grbl.receive("$J=G91Y5F6000\n");
  for (int i = 0; i < 3; ++i) turn();
  EXPECT_EQ(ask("G91 G1 X1"), "ok\r\n");
  ASSERT_TRUE(settles_at(11, 0)) << run.session.trouble_words() << run.grbl.place()[Axis::y];
  EXPECT_EQ(run.session.trouble_words(), "");
}

TEST_F(GrblBoardSender, takes_over_a_zero_that_is_set_at_the_board_between_two_lines) {
  EXPECT_EQ(ask("G1 X10 F1200"), "ok\r\n");
  ASSERT_TRUE(settles_at(10, 0));
  run.session.watch_offsets([&] { grbl_->apply_offsets(run.session.offsets()); });
  run.grbl.receive("G10L20P1X0\n");
  for (int i = 0; i < 800; ++i) turn();
  EXPECT_EQ(ask("G1 X5 F1200"), "ok\r\n");
  ASSERT_TRUE(settles_at(15, 0)) << run.grbl.place()[Axis::x] << run.session.trouble_words();
}

TEST_F(GrblBoardSender, hears_of_a_lost_connection) {
  grbl_->receive("$110=2500\n");
  for (int i = 0; i < 3; ++i) turn();
  run.port.unplugged = true;
  std::string all;
  for (int i = 0; i < 2000 && all.find("error:") == std::string::npos; ++i) {
    turn();
    all += said();
  }
  EXPECT_THAT(all, HasSubstr("error:"));
}

MachineDescription router_with_setter() {
  ToolChangePlan plan;
  plan.safe_z = 10;
  plan.change_at = MachineXy{4, 0};
  plan.measure_at = MachineXy{-6, -5};
  plan.window_low = -20;
  plan.window_high = 0;
  plan.seek = MmPerSecond(25);
  plan.latch = MmPerSecond(2);
  plan.retract = 1;
  plan.use = LengthUse::absolute;
  plan.setter_z = -10;
  MachineDescription machine = example_machine("router");
  machine.tool_change = std::make_shared<const ToolChangePlan>(plan);
  return machine;
}

class GrblBoardToolChange : public GrblBoardSender {
 protected:
  GrblBoardToolChange() : GrblBoardSender(router_with_setter()) {
    run.grbl.probe = [](const Point& place) {
      return std::abs(place[Axis::x] + 6) < 1 && std::abs(place[Axis::y] + 5) < 1 && place[Axis::z] <= -7;
    };
  }
  // What the controller says until these words have come.
  std::string hear(const std::string& words) {
    std::string all;
    for (int i = 0; i < 6000 && all.find(words) == std::string::npos; ++i) {
      turn();
      all += said();
    }
    return all;
  }
};

TEST_F(GrblBoardToolChange, measures_after_the_senders_cycle_start_and_continues) {
  // As the web interface does: what the board reports may never have been homed.
  EXPECT_THAT(ask("T1 M6"), HasSubstr("error:"));
  ASSERT_TRUE(run.session.request(request::SetPosition{{.place = run.session.status().position.place}}));
  for (int i = 0; i < 10; ++i) turn();
  grbl_->receive("G21 G90\nT1 M6\nG0 X1 Z2\n");
  EXPECT_THAT(hear("then continue]"), HasSubstr("[MSG:put tool 1 into the spindle, then continue]"));
  EXPECT_NEAR(run.grbl.place()[Axis::z], 10, 1e-6);
  grbl_->receive("~");
  EXPECT_TRUE(settles_at(1, 0));
  EXPECT_NEAR(run.grbl.place()[Axis::x], 1, 5e-3) << run.session.trouble_words();
  EXPECT_NEAR(run.grbl.place()[Axis::z], 5, 0.02) << "Z2 with a tool that is 3 mm long";
  EXPECT_EQ(run.port.sent.find("M6"), std::string::npos);
  EXPECT_EQ(run.port.sent.find("G43"), std::string::npos);
}

}  // namespace
}  // namespace passo::test
