// What a machine session does when it is asked, in this process and over a line: holds, stops, waits for the operator,
// and one activity after the other from the very place where the last one ended.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "kit/in_full.hpp"
#include "kit/random_point.hpp"
#include "kit/stage_test.hpp"
#include "pipeline/session_kit.hpp"

namespace passo {
namespace {

using test::SessionRun;
using test::start_of;
using test::xyz;

constexpr const char* around = "G21 G90 G1 F1200\nX30\nX0 Y10\nM2\n";

class Session : public testing::TestWithParam<bool> {
 protected:
  test::SessionOn on() const { return {.line = GetParam()}; }
};
INSTANTIATE_TEST_SUITE_P(, Session, testing::Bool(),
                         [](const auto& line) { return std::string(line.param ? "over_a_line" : "direct"); });

struct Ended {
  test::StepLog::Steps steps;
  double time = 0;
};
Ended whole_run(const test::SessionOn& on) {
  SessionRun run(test::short_router(), on);
  run.make_ready();
  const Seconds begun = run.now();
  run.taken(start_of(around));
  run.to_end();
  return {.steps = run.log.steps, .time = (run.now() - begun).value()};
}

TEST_P(Session, holds_a_program_on_its_path_and_resumes_it) {
  const Ended whole = whole_run(on());
  SessionRun run(test::short_router(), on());
  run.make_ready();
  const Ticket program = run.taken(start_of(around));
  run.pass(Seconds(0.7));
  const Ticket hold = run.taken(request::Hold{});
  EXPECT_EQ(run.state(), MachineState::hold);
  EXPECT_FALSE(run.outcome(hold)) << "the machine brakes yet";
  ASSERT_TRUE(run.turn_until([&] { return run.outcome(hold).has_value(); }, Seconds(0.5)));
  EXPECT_EQ(run.outcome(hold), Outcome::done);
  EXPECT_EQ(run.count(MachineChange::Kind::came_to_rest), 1U);
  EXPECT_TRUE(run.rests());
  const std::int64_t events = run.board().counts().events;
  run.pass(Seconds(2));
  EXPECT_EQ(run.board().counts().events, events);
  // At rest already: answered at once.
  const Ticket again = run.taken(request::Hold{});
  run.poll();
  EXPECT_EQ(run.outcome(again), Outcome::done);
  const Ticket resume = run.taken(request::Resume{});
  EXPECT_EQ(run.state(), MachineState::run);
  run.to_end();
  EXPECT_EQ(run.outcome(resume), Outcome::done);
  EXPECT_EQ(run.outcome(program), Outcome::done);
  EXPECT_EQ(run.state(), MachineState::idle);
  test::expect_same_way(run.log.steps, whole.steps);
  run.expect_at_place();
}

TEST_P(Session, answers_a_hold_that_is_called_off_before_the_machine_rests) {
  SessionRun run(test::short_router(), on());
  run.make_ready();
  const Ticket program = run.taken(start_of(around));
  run.pass(Seconds(0.7));
  const Ticket hold = run.taken(request::Hold{});
  run.taken(request::Resume{});
  run.poll();
  EXPECT_EQ(run.outcome(hold), Outcome::stopped);
  run.to_end();
  EXPECT_EQ(run.outcome(program), Outcome::done);
}

TEST_P(Session, stops_a_program_at_rest_with_its_outputs_off) {
  for (const bool from_hold : {false, true}) {
    SCOPED_TRACE(from_hold);
    SessionRun run(test::short_router(), on());
    run.make_ready();
    const Ticket program = run.taken(start_of("G21 M3 S1000 G1 F1200\nX30\nM2\n"));
    run.pass(Seconds(0.7));
    if (from_hold) {
      run.taken(request::Hold{});
      ASSERT_TRUE(run.turn_until([&] { return run.rests(); }));
    }
    const Ticket stop = run.taken(request::Stop{});
    EXPECT_EQ(run.refusal_of(request::Resume{}), "machine.nothing-runs") << "a stop cannot be called off";
    run.to_end(Seconds(0.5));
    EXPECT_EQ(run.outcome(program), Outcome::stopped);
    EXPECT_EQ(run.outcome(stop), Outcome::done);
    EXPECT_EQ(run.board().counts().outputs.switches, 0);
    run.expect_at_place();
    const double x = run.session().status().position.place[Axis::x];
    EXPECT_GT(x, 10);
    EXPECT_LT(x, 20);
  }
}

TEST_P(Session, waits_for_the_operator_at_stops_and_tool_changes) {
  SessionRun run(test::short_router(), on());
  run.make_ready();
  const Ticket program = run.taken(start_of("G21 G1 F1200\nX3\nM0\nX6\nM1\nX9\nT2 M6\nX12\nM2\n"));
  struct Stop {
    MachineState state;
    Action::Kind kind;
    std::uint32_t line;
    double x;
  };
  const MachineDescription& machine = run.description();
  const double steps = machine.axes[0].steps_per_unit;
  for (const Stop& stop : {Stop{MachineState::hold, Action::Kind::program_stop, 3, 3},
                           Stop{MachineState::hold, Action::Kind::optional_stop, 5, 6},
                           Stop{MachineState::tool_change, Action::Kind::tool_change, 7, 9}}) {
    SCOPED_TRACE(stop.line);
    ASSERT_TRUE(run.turn_until(stop.state, Seconds(5)));
    run.pass(Seconds(0.5));
    const MachineStatus status = run.session().status();
    ASSERT_TRUE(status.waits_for);
    EXPECT_EQ(status.waits_for->kind, stop.kind);
    EXPECT_EQ(status.waits_for->line, stop.line);
    EXPECT_TRUE(status.rests);
    EXPECT_NEAR(static_cast<double>(run.board().counts().motors[0].position), stop.x * steps, 0.5);
    EXPECT_EQ(run.refusal_of(request::Resume{}), "machine.nothing-runs") << "the program waits, nobody holds it";
    run.taken(request::OperatorDone{});
    EXPECT_EQ(run.state(), MachineState::run);
  }
  run.to_end();
  EXPECT_EQ(run.outcome(program), Outcome::done);
}

TEST_P(Session, that_is_held_where_the_program_waits_needs_both_to_be_lifted) {
  SessionRun run(test::short_router(), on());
  run.make_ready();
  const Ticket program = run.taken(start_of("G21 T2 M6\nG1 F1200 X3\nM2\n"));
  ASSERT_TRUE(run.turn_until(MachineState::tool_change, Seconds(5)));
  run.taken(request::Hold{});
  EXPECT_EQ(run.state(), MachineState::hold);
  run.taken(request::OperatorDone{});
  run.pass(Seconds(0.5));
  EXPECT_EQ(run.state(), MachineState::hold);
  EXPECT_EQ(run.board().counts().motors[0].total, 0);
  run.taken(request::Resume{});
  run.to_end();
  EXPECT_EQ(run.outcome(program), Outcome::done);
}

TEST_P(Session, overrides_make_a_program_slower_and_hold_it_at_nothing) {
  const Ended whole = whole_run(on());
  SessionRun run(test::short_router(), on());
  run.make_ready();
  run.taken(request::Override{.feed = 0.5});
  const Seconds begun = run.now();
  const Ticket program = run.taken(start_of(around));
  run.pass(Seconds(1));
  run.taken(request::Override{.feed = 0.0});
  ASSERT_TRUE(run.turn_until(MachineState::hold, Seconds(0.5)));
  EXPECT_TRUE(run.session().status().holds.has(HoldReason::zero_feed));
  run.taken(request::Override{.feed = 0.5, .adaptive_feed = 1.0});
  EXPECT_EQ(run.session().status().overrides, (Overrides{.feed = 0.5}));
  ASSERT_TRUE(run.turn_until(MachineState::run, Seconds(0.5)));
  run.to_end();
  EXPECT_EQ(run.outcome(program), Outcome::done);
  EXPECT_GT((run.now() - begun).value(), 1.9 * whole.time);
  test::expect_same_way(run.log.steps, whole.steps);
}

TEST_P(Session, stops_amid_a_long_dwell_within_a_second) {
  SessionRun run(test::short_router(), on());
  run.make_ready();
  const Ticket program = run.taken(start_of("G21 G1 F1200 X3\nG4 P100\nX6\nM2\n"));
  run.pass(Seconds(2));
  const Seconds asked = run.now();
  const Ticket stop = run.taken(request::Stop{});
  run.to_end(Seconds(1));
  EXPECT_LT((run.now() - asked).value(), 1);
  EXPECT_EQ(run.outcome(program), Outcome::stopped);
  EXPECT_EQ(run.outcome(stop), Outcome::done);
  EXPECT_NEAR(run.session().status().position.place[Axis::x], 3, 1e-3);
  run.expect_at_place();
}

TEST_P(Session, goes_on_from_where_the_last_activity_ended) {
  SessionRun run(test::short_router(), on());
  run.make_ready();
  const Ticket a = run.taken(start_of("G21 G91 G1 F1200\nX3.00071 Y-2.00033\nX1.1 Z0.777\nM2\n"));
  run.to_end();
  EXPECT_EQ(run.outcome(a), Outcome::done);
  run.expect_at_place();
  const Ticket jog = run.taken(request::Jog{
      .way = {.direction = xyz(1, 2), .speed = MmPerSecond(20), .distance = Mm(2.345)}, .lease = Seconds(10)});
  run.to_end();
  EXPECT_EQ(run.outcome(jog), Outcome::done);
  run.expect_at_place();
  const Ticket b = run.taken(start_of("G21 G91 G1 F1200\nX-0.10003 Y0.5\nM2\n"));
  run.to_end();
  EXPECT_EQ(run.outcome(b), Outcome::done);
  run.expect_at_place();
  const double jogged = 2.345 / std::sqrt(5);
  const Point place = run.session().status().position.place;
  const double bit = 2e-5;  // mm: a hundredth of a step
  EXPECT_NEAR(place[Axis::x], 3.00071 + 1.1 + jogged - 0.10003, bit);
  EXPECT_NEAR(place[Axis::y], -2.00033 + 2 * jogged + 0.5, bit);
  EXPECT_NEAR(place[Axis::z], 0.777, bit);
  const Ticket home = run.taken(request::Home{});
  run.to_end();
  EXPECT_EQ(run.outcome(home), Outcome::done);
  const Ticket c = run.taken(start_of("G21 G90 G1 F1200\nX1 Y2 Z3\nM2\n"));
  run.to_end();
  EXPECT_EQ(run.outcome(c), Outcome::done);
  EXPECT_NEAR(run.session().status().position.place[Axis::x], 1, bit);
}

TEST_P(Session, is_homed_to_a_place_that_is_true_wherever_it_thought_to_be) {
  test::SessionOn lost = on();
  lost.start = {.place = xyz(10, -10, 5), .trust = Trust::unknown};
  lost.stands_at = xyz(-7, 12.5, 20);
  SessionRun run(test::short_router(), lost);
  run.make_ready();
  EXPECT_EQ(run.session().status().position.trust, Trust::unknown);
  const Ticket home = run.taken(request::Home{});
  run.poll();
  EXPECT_EQ(run.session().status().homing_axis, Axis::z);
  run.to_end();
  EXPECT_EQ(run.outcome(home), Outcome::done);
  const KnownPosition position = run.session().status().position;
  EXPECT_EQ(position.trust, Trust::homed);
  EXPECT_EQ(position.place, home_rest(run.description()));
  run.expect_at_place();  // the virtual machine's own counts began at the truth
  const Ticket program = run.taken(start_of("G21 G90 G1 F1200 X1.5 Y2.25 Z0\nM2\n"));
  run.to_end();
  EXPECT_EQ(run.outcome(program), Outcome::done);
  EXPECT_EQ(run.session().status().position.trust, Trust::homed);
  run.expect_at_place();
}

TEST_P(Session, tells_how_far_its_place_can_be_trusted) {
  SessionRun run(test::short_router(), on());
  run.make_ready();
  EXPECT_EQ(run.session().status().position.trust, Trust::commanded);
  run.taken(start_of("G21 G1 F1200 X3\nM2\n"));
  run.to_end();
  EXPECT_EQ(run.session().status().position.trust, GetParam() ? Trust::counted : Trust::commanded);
  run.taken(request::SetPosition{{.place = xyz(5, 6, 7), .trust = Trust::homed}});
  run.taken(start_of("G21 G91 G1 F1200 X0.5\nM2\n"));
  run.to_end();
  const KnownPosition position = run.session().status().position;
  EXPECT_EQ(position.trust, Trust::homed);
  EXPECT_NEAR(position.place[Axis::x], 5.5, 1.0 / 640);
  EXPECT_EQ(run.board().counts().motors[0].position, std::llround(3.5 * 640));
  EXPECT_EQ(run.count(MachineChange::Kind::position_lost), 0U);
}

// A switch stops the motors when it closes. What stands on it already would go on.
TEST_P(Session, a_closed_limit_switch_bars_programs_and_the_way_on_but_not_the_way_off) {
  SessionRun run(test::short_router(), on());
  run.make_ready();
  const AxisDescription& x = run.description().axes[0];
  const double toward = x.home->toward_high ? 1 : -1;
  run.board().set_switch(static_cast<std::uint16_t>(input_limit << static_cast<unsigned>(x.home->input)), true);
  run.session().board().inquire(Question::status);
  ASSERT_TRUE(run.turn_until([&] { return run.session().closed_limit().has_value(); }));
  EXPECT_EQ(run.refusal_of(start_of("G21 G1 X1 F600\nM2\n")), "machine.limit-closed");
  const auto jog = [](double along_x, double along_y) {
    return request::Jog{.way = {.direction = xyz(along_x, along_y), .speed = MmPerSecond(20), .distance = Mm(2)},
                        .lease = Seconds(5)};
  };
  EXPECT_EQ(run.refusal_of(jog(toward, 0)), "machine.limit-closed");
  EXPECT_EQ(run.refusal_of(jog(toward, 1)), "machine.limit-closed");
  run.taken(jog(-toward, 0));
  run.to_end();
  run.taken(jog(0, 1));
  run.to_end();
  EXPECT_NEAR(run.session().status().position.place[Axis::x], -toward * 2, 0.01);
}

// Whatever comes after whatever, held and stopped at any moment: the motors are where the session says, and no fraction
// of a step is lost.
TEST_P(Session, does_not_drift_in_a_long_chain_of_activities) {
  test::Random random;
  SessionRun run(test::short_router(), on());
  run.make_ready();
  const std::size_t axes = run.description().axes.size();
  double farthest = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Point from = run.session().status().position.place;
    Point goal = from;
    const auto somewhere = [&] { goal = test::random_point(random, 20); };
    Ticket ticket = 0;
    const double kind = random.between(0, 1);
    const bool whole = random.chance(0.6);
    if (kind < 0.03) {
      ticket = run.taken(request::Home{});
    } else if (kind < 0.4) {
      Point direction = test::random_point(random, 1);
      direction[Axis::z] = 0;
      ticket = run.taken(request::Jog{.way = {.direction = direction,
                                              .speed = MmPerSecond(random.between(1, 60)),
                                              .distance = Mm(random.between(0.001, 5))},
                                      .lease = Seconds(random.between(0.1, 1))});
    } else {
      std::string text = "G21 G90 G64 P0.01\n";
      const int moves = static_cast<int>(random.between(1, 4));
      for (int k = 0; k < moves; ++k) {
        somewhere();
        char line[96];
        std::snprintf(line, sizeof line, "G1 F%.0f X%.17g Y%.17g Z%.17g\n", random.between(600, 3000), goal[Axis::x],
                      goal[Axis::y], goal[Axis::z]);
        text += line;
      }
      ticket = run.taken(start_of(text + "M2\n"));
    }
    const bool is_program = run.state() == MachineState::run;
    if (!whole) {
      run.pass(Seconds(random.between(0, 1)));
      if (is_program && run.session().busy() && random.chance(0.7)) {
        run.taken(request::Hold{});
        run.pass(Seconds(random.between(0, 0.3)));
        if (run.session().busy() && random.chance(0.8)) static_cast<void>(run.ask(request::Resume{}));
      }
      if (run.session().busy() && (run.state() == MachineState::hold || random.chance(0.4))) run.taken(request::Stop{});
    }
    run.to_end();
    ASSERT_TRUE(run.outcome(ticket));
    run.expect_at_place();
    const MachineStatus status = run.session().status();
    for (std::size_t m = 0; is_program && run.outcome(ticket) == Outcome::done && m < axes; ++m) {
      const AxisDescription& axis = run.description().axes[m];
      const double off = std::fabs(status.position.place[axis.axis] - goal[axis.axis]) * axis.steps_per_unit;
      farthest = std::max(farthest, off);
    }
    ASSERT_FALSE(HasFailure());
  }
  std::printf("after a program at most %.4f steps from its end\n", farthest);
  EXPECT_LT(farthest, 0.01);
  EXPECT_EQ(run.count(MachineChange::Kind::position_lost), 0U);
}

}  // namespace
}  // namespace passo
