// What happens at the board itself: a pendant, a zero at its panel, its hold input, a reset, a motor that stalls.
#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"
#include <gmock/gmock.h>

#include "passo/interpreter/saved_offsets.hpp"
#include "passo/sender/grbl_machine_session.hpp"

namespace passo::test {
namespace {

using testing::HasSubstr;

struct GrblAtTheBoard : testing::Test {
  explicit GrblAtTheBoard() : run(example_machine("router")) {}
  // A program that waits at M0, at X10 Y5 Z-2.
  std::optional<Ticket> wait_at_a_stop() {
    EXPECT_TRUE(run.go_online());
    const auto ticket = run.ask(grbl_start("G21 G90\nG1 X10 Y5 Z-2 F1200\nM0\nG1 X20\nG2 X30 I5 J0\nM2\n"));
    EXPECT_TRUE(run.play([&] { return run.session.status().waits_for.has_value(); }));
    return ticket;
  }
  GrblSessionRun run;
};

TEST_F(GrblAtTheBoard, a_pendant_may_move_it_while_the_program_waits) {
  const auto ticket = wait_at_a_stop();
  // It also leaves other modes.
  run.grbl.receive("G91\nG0 Z12\nG0 X-7 Y3\nG20\n");
  run.play_for(Seconds(3));
  EXPECT_EQ(run.session.state(), MachineState::hold) << run.session.trouble_words();
  EXPECT_NEAR(run.grbl.place()[Axis::x], 3, 1e-3);
  double lowest_on_the_way = 100;
  ASSERT_TRUE(run.ask(request::OperatorDone{}));
  ASSERT_TRUE(run.play([&] {
    const Point at = run.grbl.place();
    const bool is_over = std::hypot(at[Axis::x] - 10, at[Axis::y] - 5) > 0.01 && at[Axis::x] < 9.9;
    if (is_over) lowest_on_the_way = std::min(lowest_on_the_way, at[Axis::z]);
    return run.answer_to(*ticket).has_value();
  }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done);
  EXPECT_NEAR(lowest_on_the_way, 10, 1e-3) << "it goes back at the height at which the pendant has left it";
  EXPECT_NEAR(run.grbl.place()[Axis::x], 30, 1e-3);
  EXPECT_NEAR(run.grbl.place()[Axis::y], 5, 1e-3);
  EXPECT_NEAR(run.grbl.place()[Axis::z], -2, 1e-3);
}

TEST_F(GrblAtTheBoard, a_zero_that_is_set_while_the_program_waits_ends_it_at_rest) {
  const auto ticket = wait_at_a_stop();
  run.grbl.receive("G10L20P1Z0\n");
  run.play_for(Seconds(3));
  ASSERT_TRUE(run.ask(request::OperatorDone{}));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::failed);
  EXPECT_THAT(run.answer_to(*ticket)->fault->message(), HasSubstr("zero was changed at the machine"));
  EXPECT_NEAR(run.grbl.place()[Axis::x], 10, 1e-3);
  EXPECT_FALSE(run.session.lost_place());
  run.play_for(Seconds(1));
  EXPECT_NEAR(run.session.board().offsets.at("G54")[Axis::z], -2, 1e-3);
}

TEST_F(GrblAtTheBoard, a_zero_that_is_set_at_it_becomes_ours) {
  ASSERT_TRUE(run.go_online());
  int news = 0;
  run.session.watch_offsets([&] { ++news; });
  run.play_for(Seconds(3));
  EXPECT_EQ(news, 0);
  run.grbl.receive("G10L2P1X50Y-3\n");
  run.play_for(Seconds(6));
  EXPECT_EQ(news, 1);
  EXPECT_NEAR(saved_point(run.session.offsets(), work_offset_parameter(1))[Axis::x], 50, 1e-3);
}

TEST_F(GrblAtTheBoard, no_program_is_resumed_while_its_hold_input_is_active) {
  ASSERT_TRUE(run.go_online());
  ASSERT_TRUE(run.ask(grbl_start("G21 G90\nG1 X100 F1200\nM2\n")));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 10; }));
  run.grbl.receive("!");
  run.grbl.held_input = true;
  ASSERT_TRUE(run.play([&] { return run.session.state() == MachineState::hold && run.session.status().rests; }));
  EXPECT_FALSE(run.ask(request::Resume{}));
  EXPECT_THAT(run.refusal->message(), HasSubstr("hold input"));
  run.grbl.held_input = false;
  run.play_for(Seconds(0.5));
  EXPECT_TRUE(run.ask(request::Resume{}));
  run.ask_and_wait(request::Stop{});
}

// Grbl reports Hold then, and executes no line until a cycle start.
TEST_F(GrblAtTheBoard, nothing_begins_while_it_is_held_at_rest) {
  ASSERT_TRUE(run.go_online());
  run.grbl.held_input = true;
  run.grbl.receive("!");
  ASSERT_TRUE(run.play([&] { return run.session.status().holds.has(HoldReason::operator_hold); }, Seconds(2)));
  const request::Jog jog{.way = {.direction = Point{{{1, 0, 0}}}, .speed = MmPerSecond(20), .distance = Mm(1)},
                         .lease = Seconds(5)};
  const std::string program = "G21 G90\nG1 X5 F1200\nM2\n";
  EXPECT_FALSE(run.ask(grbl_start(program)));
  EXPECT_THAT(run.refusal->message(), HasSubstr("hold input of the board is active"));
  EXPECT_EQ(run.refusal->arguments.back().second, "ability.grbl.hold-input-first");
  EXPECT_FALSE(run.ask(jog));
  EXPECT_FALSE(run.ask(request::Resume{})) << "the input is active";
  // Its button is released, and the board is still held.
  run.grbl.held_input = false;
  ASSERT_TRUE(run.play([&] { return (run.session.status().inputs & input_hold) == 0; }, Seconds(2)));
  EXPECT_FALSE(run.ask(jog));
  EXPECT_EQ(run.refusal->arguments.back().second, "ability.grbl.held");
  ASSERT_TRUE(run.ask(request::Resume{}));
  ASSERT_TRUE(run.play([&] { return !run.session.status().holds.has(HoldReason::operator_hold); }, Seconds(2)));
  const auto done = run.ask_and_wait(grbl_start(program));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, Outcome::done);
}

// The request was accepted before the report of the hold.
TEST_F(GrblAtTheBoard, a_program_that_is_held_before_its_first_line_rests_in_a_hold) {
  ASSERT_TRUE(run.go_online());
  run.grbl.receive("!");
  const auto ticket = run.ask(grbl_start("G21 G90\nG1 X5 F1200\nM2\n"));
  ASSERT_TRUE(ticket);
  ASSERT_TRUE(run.play_until(MachineState::hold, Seconds(2)));
  EXPECT_TRUE(run.session.status().rests) << "it does not decelerate";
  ASSERT_TRUE(run.ask(request::Resume{}));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done);
}

TEST_F(GrblAtTheBoard, outputs_are_those_that_it_reports) {
  ASSERT_TRUE(run.go_online());
  const auto outputs = [&] { return run.session.status().outputs; };
  EXPECT_EQ(outputs(), OutputState());
  run.grbl.receive("M8\nM4S500\n");
  EXPECT_TRUE(
      run.play([&] { return outputs().flood && outputs().spindle == SpindleDirection::counterclockwise; }, Seconds(3)))
      << "at rest";
  EXPECT_EQ(outputs().revolutions_per_minute, 500);
  run.grbl.receive("M9\nM5\n");
  EXPECT_TRUE(run.play([&] { return outputs() == OutputState(); }, Seconds(3)));
  const auto ticket = run.ask(grbl_start("G21 G90\nM3 S900\nG1 X60 F1200\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 5; }));
  EXPECT_EQ(outputs().spindle, SpindleDirection::clockwise);
  EXPECT_EQ(outputs().revolutions_per_minute, 900);
  run.grbl.receive("\xA0");
  EXPECT_TRUE(run.play([&] { return outputs().flood; }, Seconds(1))) << "by a pendant";
  EXPECT_EQ(outputs().revolutions_per_minute, 900);
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_TRUE(run.play([&] { return !run.session.works(); }, Seconds(1)));
  EXPECT_FALSE(run.grbl.parser_modes().flood) << "the end of a program switches everything off";
  EXPECT_TRUE(run.play([&] { return outputs() == OutputState(); }, Seconds(1)));
}

// The board can only toggle them. The second request comes before the report of the first.
TEST_F(GrblAtTheBoard, an_output_that_is_switched_on_twice_is_on) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nG1 X60 F1200\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 5; }));
  ASSERT_TRUE(run.ask(request::SwitchOutputs{.flood = true}));
  ASSERT_TRUE(run.ask(request::SwitchOutputs{.flood = true}));
  EXPECT_TRUE(run.session.status().outputs.flood);
  run.play_for(Seconds(0.3));
  EXPECT_TRUE(run.grbl.parser_modes().flood);
  EXPECT_TRUE(run.session.status().outputs.flood);
  ASSERT_TRUE(run.ask(request::SwitchOutputs{.flood = false}));
  run.play_for(Seconds(0.3));
  EXPECT_FALSE(run.session.status().outputs.flood);
  EXPECT_FALSE(run.grbl.parser_modes().flood);
  EXPECT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
}

TEST_F(GrblAtTheBoard, a_door_shows_the_outputs_off_until_the_machine_goes_on) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nM3 S900\nM8\nG1 X60 F1200\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 5; }));
  run.grbl.open_door(true);
  ASSERT_TRUE(run.play([&] { return run.session.state() == MachineState::door && run.session.status().rests; }));
  EXPECT_TRUE(run.play([&] { return run.session.status().outputs == OutputState(); }, Seconds(1)));
  run.grbl.open_door(false);
  run.play_for(Seconds(0.3));
  ASSERT_TRUE(run.ask(request::Resume{}));
  ASSERT_TRUE(run.play_until(MachineState::run));
  EXPECT_TRUE(run.session.status().outputs.flood);
  EXPECT_EQ(run.session.status().outputs.spindle, SpindleDirection::clockwise);
  EXPECT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
}

TEST_F(GrblAtTheBoard, overrides_are_those_that_it_reports) {
  ASSERT_TRUE(run.go_online());
  const auto overrides = [&] { return run.session.status().overrides; };
  const auto ticket = run.ask(grbl_start("G21 G90\nM3 S1000\nG1 X100 F1200\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 5; }));
  run.grbl.receive("\x92\x96\x9A");  // by a pendant
  EXPECT_TRUE(run.play([&] { return overrides().feed == 0.9; }, Seconds(2)));
  EXPECT_EQ(overrides().rapids, 0.5);
  EXPECT_EQ(overrides().spindle, 1.1);
  EXPECT_NEAR(run.session.status().outputs.revolutions_per_minute, 1000, 1e-6) << "without the override";
  ASSERT_TRUE(run.ask(request::Override{.feed = 1.3}));
  for (int i = 0; i < 100; ++i) {
    run.play_for(Seconds(0.02));
    EXPECT_EQ(overrides().feed, 1.3) << "no report from before the request counts";
  }
  EXPECT_EQ(overrides().spindle, 1.1);
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  run.play_for(Seconds(3));
  EXPECT_EQ(overrides(), Overrides()) << "as at the end of each program";
}

TEST_F(GrblAtTheBoard, a_stall_is_noticed_within_seconds_though_all_was_answered) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nG1 X20 F1200\nG1 X0 F60\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 10; }));
  // It reports that it runs, and where it stands.
  const std::string stands = fmt::format("<Run|MPos:{:.3f},0.000,0.000|FS:0,0>", run.grbl.place()[Axis::x]);
  run.grbl.own_report = [stands] { return stands; };
  const Seconds stalled = run.session.now();
  Seconds noticed{0};
  ASSERT_TRUE(run.play([&] {
    if (noticed == Seconds(0) && run.session.sender().fault()) noticed = run.session.now();
    return run.answer_to(*ticket).has_value();
  }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::failed);
  EXPECT_LT((noticed - stalled).value(), 5);
}

TEST_F(GrblAtTheBoard, a_reset_in_motion_stops_at_once_and_loses_the_place) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nG1 X100 F1200\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 10; }));
  ASSERT_TRUE(run.ask(request::ResetMachine{}));
  const double at = run.grbl.place()[Axis::x];
  ASSERT_TRUE(run.play_until(MachineState::idle));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::failed);
  EXPECT_THAT(run.answer_to(*ticket)->fault->message(), HasSubstr("reset by hand in motion"));
  EXPECT_NEAR(run.grbl.place()[Axis::x], at, 0.2);
  EXPECT_TRUE(run.session.lost_place());
  EXPECT_FALSE(run.ask(grbl_start("G21 G90\nG1 X1 F1200\nM2\n")));
}

TEST_F(GrblAtTheBoard, a_reset_in_a_hold_keeps_the_place) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nG1 X100 F1200\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 10; }));
  ASSERT_TRUE(run.ask_and_wait(request::Hold{}, Seconds(2)));
  ASSERT_TRUE(run.ask(request::ResetMachine{}));
  ASSERT_TRUE(run.play_until(MachineState::idle));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::failed);
  EXPECT_FALSE(run.session.lost_place());
  EXPECT_NEAR(run.session.status().position.place[Axis::x], run.grbl.place()[Axis::x], 1e-3);
}

// grblHAL with bit 9 of $10 sends its modes whenever they change.
TEST(GrblTellingItsModes, unasked_is_no_lost_line) {
  GrblSessionRun run(example_machine("router"), [](StrictGrbl& grbl) {
    grbl.greeting = "GrblHAL 1.1f ['$' or '$HELP' for help]";
    grbl.settings =
        "$10=1023\r\n$13=0\r\n$100=250\r\n$101=250\r\n$102=250\r\n$110=3000\r\n$111=3000\r\n$112=3000\r\n"
        "$120=500\r\n$121=500\r\n$122=500\r\n";
  });
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nG1 X5 F1200\nG0 Y5\nG1 X0 F600\nG1 Y0\nM2\n"));
  int turns = 0;
  ASSERT_TRUE(run.play([&] {
    if (++turns % 7 == 0) run.grbl.say("[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]");
    return run.answer_to(*ticket).has_value();
  }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done) << run.session.trouble_words();
}

TEST_F(GrblAtTheBoard, its_words_reach_nobody_with_control_characters) {
  run.grbl.refused = "G1X5";
  ASSERT_TRUE(run.go_online());
  run.grbl.say("[MSG:WARN: \x1b[31mred\xff]");
  run.play_for(Seconds(0.2));
  const auto messages = run.session.take_messages();
  ASSERT_FALSE(messages.empty());
  EXPECT_EQ(messages.back(), "WARN: ?[31mred?");
}

}  // namespace
}  // namespace passo::test
