#include "passo/sender/grbl_machine_session.hpp"

#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"
#include <gmock/gmock.h>

#include "passo/journal/reentry.hpp"

namespace passo::test {
namespace {

using testing::HasSubstr;

constexpr const char* square = "G21 G90\nG1 X10 F1200\nG1 Y10\nG1 X0\nG1 Y0\nM2\n";

struct GrblSessions : testing::Test {
  explicit GrblSessions() : run(example_machine("router")) {}
  GrblSessionRun run;
};

TEST_F(GrblSessions, know_the_board_and_where_it_is) {
  EXPECT_FALSE(run.ask(request::Home{})) << "not before it has answered";
  ASSERT_TRUE(run.go_online());
  EXPECT_EQ(run.session.board().firmware, "Grbl");
  EXPECT_EQ(run.session.status().position.trust, Trust::commanded);
  EXPECT_FALSE(run.session.lost_place());
  EXPECT_FALSE(run.session.abilities().can(Ability::exact_resume));
  EXPECT_FALSE(run.session.abilities().can(Ability::home)) << "$22=0";
  EXPECT_TRUE(run.session.abilities().can(Ability::jog));
}

TEST_F(GrblSessions, run_a_program_to_its_end) {
  ASSERT_TRUE(run.go_online());
  request::Start start = grbl_start(square);
  start.nominal_time = Seconds(2);
  const auto ticket = run.ask(std::move(start));
  ASSERT_TRUE(ticket);
  EXPECT_EQ(run.session.state(), MachineState::run);
  EXPECT_FALSE(run.ask(request::Home{}));
  std::uint32_t last = 0;
  double progress = 0;
  ASSERT_TRUE(run.play([&] {
    const MachineStatus status = run.session.status();
    if (run.session.busy()) EXPECT_GE(status.executes.line, last) << "lines do not go back";
    if (status.executes.line > 0) last = status.executes.line;
    EXPECT_LE(status.progress.value_or(0), 1);
    progress = std::max(progress, status.progress.value_or(0));
    return run.answer_to(*ticket).has_value();
  }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done);
  EXPECT_EQ(run.session.state(), MachineState::idle);
  EXPECT_GT(last, 3U);
  EXPECT_GT(progress, 0.7);
  EXPECT_NEAR(run.grbl.place()[Axis::x], 0, 1e-9);
  EXPECT_TRUE(run.session.program_results());
}

TEST_F(GrblSessions, hold_on_the_path_and_go_on) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nG1 X100 F1200\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 10; }));
  const auto held = run.ask_and_wait(request::Hold{}, Seconds(2));
  ASSERT_TRUE(held);
  EXPECT_EQ(held->outcome, Outcome::done);
  EXPECT_EQ(run.session.state(), MachineState::hold);
  EXPECT_TRUE(run.session.status().rests);
  EXPECT_EQ(run.count(MachineChange::Kind::came_to_rest), 1U);
  const double rests_at = run.grbl.place()[Axis::x];
  run.play_for(Seconds(2));
  EXPECT_EQ(run.grbl.place()[Axis::x], rests_at);
  ASSERT_TRUE(run.ask(request::Resume{}));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done);
  EXPECT_NEAR(run.grbl.place()[Axis::x], 100, 1e-9);
}

TEST_F(GrblSessions, a_stop_brakes_on_the_path_and_keeps_the_position) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nM3 S1000\nG1 X100 F1200\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 10; }));
  ASSERT_TRUE(run.ask_and_wait(request::Stop{}, Seconds(5)));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::stopped);
  EXPECT_EQ(run.session.state(), MachineState::idle);
  EXPECT_FALSE(run.session.lost_place());
  EXPECT_NEAR(run.session.status().position.place[Axis::x], run.grbl.place()[Axis::x], 1e-3);
  // The next program runs from there.
  const auto next = run.ask_and_wait(grbl_start(square));
  ASSERT_TRUE(next);
  EXPECT_EQ(next->outcome, Outcome::done);
}

TEST_F(GrblSessions, do_not_resume_while_a_stop_brakes) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nG1 X100 F1200\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 10; }));
  ASSERT_TRUE(run.ask_and_wait(request::Hold{}, Seconds(2)));
  const double rests_at = run.grbl.place()[Axis::x];
  run.port.sent.clear();
  ASSERT_TRUE(run.ask(request::Stop{}));
  EXPECT_FALSE(run.ask(request::Resume{}));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.port.sent.find('~'), std::string::npos);
  EXPECT_NEAR(run.grbl.place()[Axis::x], rests_at, 1e-9);
  EXPECT_FALSE(run.session.lost_place());
}

TEST_F(GrblSessions, hold_a_board_that_ignores_a_hold_at_rest) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nG4 P2\nG1 X10 F1200\nM2\n"));
  ASSERT_TRUE(ticket);
  run.grbl.ignores_hold_at_rest = true;
  ASSERT_TRUE(run.ask(request::Hold{}));
  run.play_for(Seconds(4));
  EXPECT_EQ(run.session.state(), MachineState::hold);
  EXPECT_EQ(run.grbl.place()[Axis::x], 0);
  ASSERT_TRUE(run.ask(request::Resume{}));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_NEAR(run.grbl.place()[Axis::x], 10, 1e-9);
}

TEST_F(GrblSessions, may_be_moved_by_others_after_a_program) {
  ASSERT_TRUE(run.go_online());
  ASSERT_TRUE(run.ask_and_wait(grbl_start(square)));
  run.grbl.receive("$J=G91X7F1000\n");  // a pendant at the board
  run.play_for(Seconds(2));
  EXPECT_EQ(run.session.state(), MachineState::idle) << run.session.trouble_words();
  EXPECT_NEAR(run.session.status().position.place[Axis::x], 7, 1e-3);
}

TEST_F(GrblSessions, wait_at_stops_for_the_operator) {
  ASSERT_TRUE(run.go_online());
  request::Start start = grbl_start("G21 G90\nG1 X5 F1200\n(MSG, turn it over)\nM0\nT2 M6\nG1 X9\nM2\n");
  start.options.dialect = Dialect::linuxcnc;
  const auto ticket = run.ask(std::move(start));
  ASSERT_TRUE(run.play_until(MachineState::hold));
  ASSERT_TRUE(run.session.status().waits_for);
  EXPECT_EQ(run.session.status().waits_for->words, "turn it over");
  EXPECT_EQ(run.session.status().waits_for->line, 4U);
  EXPECT_NEAR(run.grbl.place()[Axis::x], 5, 1e-9);
  EXPECT_FALSE(run.ask(request::Resume{})) << "it waits for the operator";
  ASSERT_TRUE(run.ask(request::OperatorDone{}));
  ASSERT_TRUE(run.play_until(MachineState::tool_change));
  EXPECT_EQ(run.session.status().waits_for->tool, 2);
  ASSERT_TRUE(run.ask(request::OperatorDone{}));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done);
  EXPECT_NEAR(run.grbl.place()[Axis::x], 9, 1e-9);
}

TEST_F(GrblSessions, a_released_key_stops_a_jog_soon) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(request::Jog{
      .way = {.direction = Point{{{1, 0, 0}}}, .speed = MmPerSecond(40), .distance = Mm(0)}, .lease = Seconds(0.25)});
  ASSERT_TRUE(ticket);
  for (int i = 0; i < 20; ++i) {
    run.play_for(Seconds(0.1));
    ASSERT_TRUE(run.ask(request::RenewKeepAlive{}));
  }
  EXPECT_NEAR(run.grbl.speed(), 40, 1) << "it reaches its speed";
  EXPECT_NEAR(run.session.status().speed_now.value(), 40, 1) << "as the board reports it";
  const double was = run.grbl.place()[Axis::x];
  const Seconds released = run.session.now();
  ASSERT_TRUE(run.ask(request::Stop{}));
  Seconds stands{0};
  run.play([&] {
    if (stands == Seconds(0) && run.grbl.speed() < 1e-9) stands = run.session.now();
    return run.answer_to(*ticket).has_value();
  });
  constexpr double braking = 40.0 / 500;
  EXPECT_LT((stands - released).value(), 0.1 + braking);
  EXPECT_LT(run.grbl.place()[Axis::x] - was, 40 * 0.1 + 40.0 * 40 / 2 / 500);
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::stopped);
  EXPECT_EQ(run.session.state(), MachineState::idle);
  EXPECT_NEAR(run.session.status().position.place[Axis::x], run.grbl.place()[Axis::x], 1e-3);
}

TEST_F(GrblSessions, a_cancel_at_the_end_of_a_jog_does_not_leave_a_board_that_takes_no_line) {
  run.grbl.put(120, 100);  // it brakes for longer than the pause between two cancels
  run.grbl.second_cancel_is_late = true;
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(request::Jog{
      .way = {.direction = Point{{{1, 0, 0}}}, .speed = MmPerSecond(40), .distance = Mm(0)}, .lease = Seconds(2)});
  run.play_for(Seconds(1));
  ASSERT_TRUE(run.ask(request::Stop{}));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  const double x = run.grbl.place()[Axis::x];
  const auto done = run.ask_and_wait(grbl_start("G91 G1 X2 F1200\nM2\n"));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, Outcome::done);
  EXPECT_NEAR(run.grbl.place()[Axis::x], x + 2, 0.005);
}

TEST_F(GrblSessions, a_jog_ends_with_its_lease_and_without_its_host) {
  ASSERT_TRUE(run.go_online());
  const request::Jog jog{.way = {.direction = Point{{{0, 1, 0}}}, .speed = MmPerSecond(30), .distance = Mm(0)}};
  const auto ticket = run.ask(jog);
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }, Seconds(3)));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::stopped);
  EXPECT_LT(run.grbl.place()[Axis::y], 30 * 0.25 + 30 * 0.1 + 30.0 * 30 / 1000);
  // The host dies: what lies in the board ends soon.
  ASSERT_TRUE(run.ask(request::Jog{.way = jog.way, .lease = Seconds(10)}));
  run.play_for(Seconds(0.5));
  const double was = run.grbl.place()[Axis::y];
  run.grbl.run(10);
  EXPECT_LT(run.grbl.place()[Axis::y] - was, 30 * 0.5 + 2);
  run.ask_and_wait(request::Stop{});
}

TEST_F(GrblSessions, a_jog_of_a_distance_ends_there) {
  ASSERT_TRUE(run.go_online());
  const auto done = run.ask_and_wait(request::Jog{
      .way = {.direction = Point{{{-1, 0, 0}}}, .speed = MmPerSecond(20), .distance = Mm(2.5)}, .lease = Seconds(5)});
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, Outcome::done);
  EXPECT_NEAR(run.grbl.place()[Axis::x], -2.5, 5e-3);
}

TEST_F(GrblSessions, overrides_go_to_the_board) {
  ASSERT_TRUE(run.go_online());
  ASSERT_TRUE(run.ask(grbl_start("G21 G90\nG1 X200 F600\nM2\n")));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 5; }));
  EXPECT_NEAR(run.grbl.speed(), 10, 0.1);
  ASSERT_TRUE(run.ask(request::Override{.feed = 1.5, .rapids = 0.6}));
  run.play_for(Seconds(2));
  EXPECT_NEAR(run.grbl.speed(), 15, 0.1);
  EXPECT_EQ(run.session.status().overrides.rapids, 0.5) << "what the board has";
  EXPECT_FALSE(run.ask(request::Override{.feed = 0.05}));
  EXPECT_EQ(run.refusal->reason, RefusalReason::board_cannot);
  EXPECT_THAT(run.refusal->message(), HasSubstr("10 to 200 %"));
  EXPECT_FALSE(run.ask(request::Override{.adaptive_feed = 0.5}));
  run.ask_and_wait(request::Stop{});
  EXPECT_EQ(run.session.status().overrides.feed, 1) << "a reset of the board ends them";
}

TEST_F(GrblSessions, a_refused_line_ends_the_program_at_that_line) {
  ASSERT_TRUE(run.go_online());
  run.grbl.refused = "X0";
  Diagnostics findings;
  request::Start start = grbl_start(square);
  start.findings = &findings;
  const auto done = run.ask_and_wait(std::move(start));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, Outcome::failed);
  ASSERT_TRUE(findings.any_error());
  EXPECT_EQ(findings.all().front().code, "grbl.error");
  EXPECT_EQ(findings.all().front().place.line, 4U);
  EXPECT_EQ(run.session.state(), MachineState::idle);
}

TEST_F(GrblSessions, a_limit_switch_is_an_alarm) {
  ASSERT_TRUE(run.go_online());
  run.grbl.trips = "X10Y0Z0";  // the last piece of the line
  const auto ticket = run.ask(grbl_start(square));
  ASSERT_TRUE(run.play_until(MachineState::alarm));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::failed);
  EXPECT_EQ(run.answer_to(*ticket)->fault->fault, MachineFault::board_stopped);
  EXPECT_TRUE(run.session.status().position.is_lost);
  ASSERT_TRUE(run.ask(request::ResetMachine{}));
  ASSERT_TRUE(run.go_online());
  EXPECT_TRUE(run.session.lost_place());
}

TEST_F(GrblSessions, a_restart_or_a_cut_is_a_fault_and_nothing_is_sent_twice) {
  for (const bool is_cut : {false, true}) {
    SCOPED_TRACE(is_cut);
    ASSERT_TRUE(run.go_online());
    if (run.session.lost_place()) {
      ASSERT_TRUE(run.ask(request::SetPosition{{.place = run.session.status().position.place}}));
    }
    const auto ticket = run.ask(grbl_start("G21 G90\nG91\nG1 X10 F1200\nG1 X10\nG1 X10\nG1 X10\nG1 X10\nM2\n"));
    ASSERT_TRUE(ticket);
    const double from = run.grbl.place()[Axis::x];
    ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > from + 15; }));
    run.port.sent.clear();
    const Seconds then = run.session.now();
    is_cut ? void(run.port.unplugged = true) : run.grbl.restart();
    ASSERT_TRUE(run.play_until(MachineState::fault, Seconds(2)));
    EXPECT_LT(run.session.now() - then, Seconds(2));
    EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::failed);
    EXPECT_THAT(run.session.trouble_words(), HasSubstr("the machine was at line 4 of the program"));
    run.play_for(Seconds(3));
    EXPECT_EQ(run.port.sent.find('X'), std::string::npos) << run.port.sent;
    run.port.unplugged = false;
    run.grbl.run(20);
    ASSERT_TRUE(run.ask(request::ResetMachine{}));
    ASSERT_TRUE(run.go_online());
    EXPECT_EQ(run.port.sent.find('X'), std::string::npos) << run.port.sent;
    EXPECT_TRUE(run.session.lost_place());
  }
}

TEST_F(GrblSessions, an_open_door_holds_a_program_until_somebody_goes_on) {
  ASSERT_TRUE(run.go_online());
  const auto ticket = run.ask(grbl_start("G21 G90\nG1 X100 F1200\nM2\n"));
  ASSERT_TRUE(run.play([&] { return run.grbl.place()[Axis::x] > 10; }));
  run.grbl.open_door(true);
  ASSERT_TRUE(run.play_until(MachineState::door, Seconds(2)));
  run.play_for(Seconds(1));
  EXPECT_FALSE(run.ask(request::Resume{})) << "it is open";
  run.grbl.open_door(false);
  run.play_for(Seconds(1));
  EXPECT_EQ(run.session.state(), MachineState::door);
  ASSERT_TRUE(run.ask(request::Resume{}));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done);
}

TEST_F(GrblSessions, lines_of_a_client_run_as_they_come) {
  ASSERT_TRUE(run.go_online());
  InterpreterOptions options;
  options.dialect = Dialect::grbl;
  StreamedProgram lines(run.description, options, Point());
  ASSERT_FALSE(lines.add_line("G1 X5 F1200", run.session.now()));
  const auto ticket = run.ask(request::Stream{.program = &lines});
  ASSERT_TRUE(run.play_until(MachineState::await_line));
  EXPECT_NEAR(run.grbl.place()[Axis::x], 5, 1e-9);
  ASSERT_FALSE(lines.add_line("G0 Y7", run.session.now()));
  ASSERT_TRUE(
      run.play([&] { return run.grbl.place()[Axis::y] == 7 && run.session.state() == MachineState::await_line; }));
  const Seconds before = run.session.now();
  ASSERT_TRUE(run.ask_and_wait(request::Stop{}));
  EXPECT_LT(run.session.now() - before, Seconds(0.1)) << "a machine at rest is not reset";
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::stopped);
}

TEST_F(GrblSessions, work_offsets_are_those_of_the_board) {
  ASSERT_TRUE(run.go_online());
  SavedParameters parameters = run.session.offsets();
  EXPECT_EQ(parameters.at(5221), 0);
  parameters[5221] = 12.5;
  parameters[5242] = -3;
  run.session.store_offsets(parameters);
  run.play([&] { return !run.session.works(); });
  EXPECT_THAT(run.port.sent, HasSubstr("G21G10L2P1X12.5000\n"));
  EXPECT_THAT(run.port.sent, HasSubstr("G10L2P2Y-3.0000\n"));
  request::Start start = grbl_start("G21 G90\nG0 X2\nM2\n");
  start.options.parameters = parameters;
  ASSERT_TRUE(run.ask_and_wait(std::move(start)));
  EXPECT_NEAR(run.grbl.place()[Axis::x], 14.5, 1e-9);
  EXPECT_EQ(run.session.offsets().at(5221), 12.5);
}

TEST_F(GrblSessions, begin_a_program_at_a_line) {
  ASSERT_TRUE(run.go_online());
  request::Start start = grbl_start(square);
  InterpreterOptions options = start.options;
  const auto way = reentry_at_line(start.program, run.description, options, {.line = 4});
  ASSERT_TRUE(way);
  start.from = way->at;
  start.lead_in = way->lead_in;
  run.port.sent.clear();
  const auto done = run.ask_and_wait(std::move(start));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, Outcome::done);
  EXPECT_THAT(run.port.sent, HasSubstr("X10Y10"));
  EXPECT_NEAR(run.grbl.place()[Axis::y], 0, 1e-9);
}

}  // namespace
}  // namespace passo::test
