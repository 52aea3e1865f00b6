// GrblMachineSession: homing, unlocking, probing.
#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"
#include <gmock/gmock.h>

namespace passo::test {
namespace {

using testing::HasSubstr;

constexpr const char* short_way = "G21 G90\nG1 X10 F1200\nG1 Y10\nM2\n";

TEST(GrblSession, homes_a_single_axis_where_the_board_can) {
  const auto switched = [](StrictGrbl& grbl) {
    grbl.put(22, 1);
    grbl.options = "VH,15,128";
  };
  GrblSessionRun run(example_machine("router"), switched);
  ASSERT_TRUE(run.go_online());
  EXPECT_TRUE(run.session.abilities().can(Ability::home_axis));
  // The place is known when all axes have been homed.
  for (const Axis axis : {Axis::x, Axis::z, Axis::y}) {
    EXPECT_TRUE(run.session.lost_place());
    const auto homed = run.ask_and_wait(request::Home{.axis = axis});
    ASSERT_TRUE(homed);
    EXPECT_EQ(homed->outcome, Outcome::done);
  }
  EXPECT_FALSE(run.session.lost_place());
  EXPECT_EQ(run.session.status().position.trust, Trust::homed);
  EXPECT_THAT(run.port.sent, HasSubstr("$HX\n"));
  ASSERT_TRUE(run.ask_and_wait(request::Home{.axis = Axis::x}));
  EXPECT_FALSE(run.session.lost_place());
}

TEST(GrblSession, homes_no_single_axis_on_a_board_that_cannot) {
  GrblSessionRun run(example_machine("router"));
  run.grbl.put(22, 1);
  run.grbl.restart();
  ASSERT_TRUE(run.go_online());
  EXPECT_FALSE(run.ask(request::Home{.axis = Axis::x}));
  EXPECT_EQ(run.refusal->reason, RefusalReason::board_cannot);
  EXPECT_THAT(run.refusal->message(), HasSubstr("homes all its axes together"));
}

TEST(GrblSession, homes_and_then_knows_its_place) {
  GrblSessionRun run(example_machine("router"), [](StrictGrbl& grbl) { grbl.put(22, 1); });
  ASSERT_TRUE(run.go_online());
  EXPECT_TRUE(run.session.lost_place()) << "it was locked at its start";
  EXPECT_FALSE(run.ask(grbl_start(short_way)));
  const auto homed = run.ask_and_wait(request::Home{});
  ASSERT_TRUE(homed);
  EXPECT_EQ(homed->outcome, Outcome::done);
  EXPECT_EQ(run.session.status().position.trust, Trust::homed);
  const auto done = run.ask_and_wait(grbl_start(short_way));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, Outcome::done);
}

TEST(GrblSession, unlocks_where_the_operator_confirms_the_place) {
  GrblSessionRun run(example_machine("router"), [](StrictGrbl& grbl) { grbl.put(22, 1); });
  ASSERT_TRUE(run.go_online());
  EXPECT_FALSE(run.ask(request::SetPosition{{.place = Point{{{5, 0, 0}}}}})) << "a board keeps its own position";
  EXPECT_EQ(run.refusal->reason, RefusalReason::board_cannot);
  ASSERT_TRUE(run.ask(request::SetPosition{{.place = run.session.status().position.place}}));
  EXPECT_FALSE(run.session.lost_place());
  const auto done = run.ask_and_wait(grbl_start(short_way));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, Outcome::done);
}

TEST(GrblSession, homing_without_switches_is_an_alarm_that_a_reset_ends) {
  GrblSessionRun run(example_machine("router"), [](StrictGrbl& grbl) {
    grbl.put(22, 1);
    grbl.has_switches = false;
  });
  ASSERT_TRUE(run.go_online());
  const auto homed = run.ask_and_wait(request::Home{});
  ASSERT_TRUE(homed);
  EXPECT_EQ(homed->outcome, Outcome::failed);
  EXPECT_EQ(run.session.state(), MachineState::alarm);
  EXPECT_THAT(run.session.trouble_words(), HasSubstr("ALARM:9"));
  EXPECT_FALSE(run.ask(request::Home{}));
  ASSERT_TRUE(run.ask(request::ResetMachine{}));
  ASSERT_TRUE(run.go_online());
  EXPECT_TRUE(run.session.lost_place());
}

TEST(GrblSession, finds_contacts_by_probe_moves_and_in_programs) {
  GrblSessionRun run(example_machine("router"),
                     [](StrictGrbl& grbl) { grbl.probe = [](const Point& place) { return place[Axis::z] <= -4; }; });
  ASSERT_TRUE(run.go_online());
  const auto done = run.ask_and_wait(request::Probe{.target = Point{{{0, 0, -10}}}, .speed = MmPerSecond(2)});
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, Outcome::done);
  const auto found = std::ranges::find(run.changes, MachineChange::Kind::probed, &MachineChange::kind);
  ASSERT_NE(found, run.changes.end());
  EXPECT_TRUE(found->probe->touched);
  EXPECT_NEAR(found->probe->contact[Axis::z], -4, 0.02);
  // It is triggered already.
  const auto before = run.ask_and_wait(request::Probe{.target = Point{{{0, 0, -10}}}, .speed = MmPerSecond(2)});
  ASSERT_TRUE(before);
  ASSERT_TRUE(before->fault);
  EXPECT_EQ(before->fault->fault, MachineFault::probe_before);
  // A program that makes its zero of the contact.
  request::Start start = grbl_start("G21 G90\nG53 G0 Z0\nG38.2 Z-10 F120\nG10 L20 P1 Z0\nG0 Z3\nM2\n");
  start.options.dialect = Dialect::linuxcnc;
  const auto program = run.ask_and_wait(std::move(start));
  ASSERT_TRUE(program);
  EXPECT_EQ(program->outcome, Outcome::done);
  EXPECT_NEAR(run.grbl.place()[Axis::z], -1, 0.02);
  EXPECT_NEAR(run.session.program_results()->parameters.at(5223), -4, 0.02);
}

TEST(GrblSession, a_probe_move_that_meets_nothing_fails_and_leaves_the_machine_idle) {
  GrblSessionRun run(example_machine("router"));
  ASSERT_TRUE(run.go_online());
  const auto done = run.ask_and_wait(request::Probe{.target = Point{{{0, 0, -3}}}, .speed = MmPerSecond(2)});
  ASSERT_TRUE(done);
  EXPECT_EQ(done->fault->fault, MachineFault::probe_untouched);
  EXPECT_EQ(run.session.state(), MachineState::idle);
}

}  // namespace
}  // namespace passo::test
