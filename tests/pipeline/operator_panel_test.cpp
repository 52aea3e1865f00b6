// The buttons and the door of a board over a line: hold, go on, and nothing is lost.
#include <cstdio>
#include <string>
#include <vector>

#include "pipeline/panel_kit.hpp"
#include "pipeline/session_kit.hpp"

namespace passo {
namespace {

using test::along;
using test::reaction;
using test::StepLog;

struct Press {
  double at = 0;  // since the start
  std::uint16_t which = 0;
  bool closed = true;
};

struct Held {
  StepLog::Steps steps;
  std::vector<double> rests;  // when it came to rest in a hold
  double begun = 0;
  double end = 0;
};

Held run(const std::string& program, const char* name, const std::vector<Press>& presses, bool lose_captured = false) {
  const MachineDescription machine = test::example_machine(name);
  test::SessionRun run(machine, {.line = true});
  run.line().set_trouble([&](bool to_board, VirtualLine::Bytes bytes) {
    const bool captured = !to_board && bytes[2] == 0x99;
    return captured && lose_captured ? VirtualLine::Bytes() : bytes;
  });
  run.make_ready();
  const Ticket ticket = run.taken(test::start_of(program));
  Held held;
  held.begun = run.now().value();
  const auto since = [&](Seconds time) { return time.value() - held.begun; };
  std::size_t next = 0;
  while (run.session().busy() && since(run.now()) < 60) {
    for (; next < presses.size() && since(run.now()) >= presses[next].at; ++next) {
      run.board().set_switch(presses[next].which, presses[next].closed);
    }
    run.poll();
  }
  EXPECT_FALSE(run.session().board().error());
  EXPECT_EQ(run.outcome(ticket), Outcome::done);
  test::expect_within_limits(machine, run.log.steps);
  for (const MachineChange& change : run.changes) {
    if (change.kind == MachineChange::Kind::came_to_rest) held.rests.push_back(since(change.time));
  }
  held.steps = run.log.steps;
  held.end = since(run.now());
  return held;
}

const std::vector<Press> hold_and_start = {
    {2, input_hold, true}, {2.05, input_hold, false}, {4, input_start, true}, {4.05, input_start, false}};

TEST(OperatorPanel, holds_on_the_path_and_goes_on) {
  for (const char* name : {"router", "uno"}) {
    const Held whole = run(along, name, {});
    EXPECT_TRUE(whole.rests.empty());
    const Held held = run(along, name, hold_and_start);
    ASSERT_EQ(held.rests.size(), 1U);
    EXPECT_GT(held.end, whole.end + 1.8);
    test::expect_same_way(held.steps, whole.steps);
    const double clock = test::example_machine(name).board.clock.value();
    const double slower = reaction(held.steps[0], clock, held.begun + 2);
    std::printf("%s: %.1f ms from the button to the first step that is late, at rest after %.0f ms\n", name,
                slower * 1000, (held.rests[0] - 2) * 1000);
    EXPECT_GT(slower, 0);
    EXPECT_LT(slower, 0.125);
  }
}

TEST(OperatorPanel, an_open_door_holds_until_it_is_closed_and_somebody_starts) {
  const Held whole = run(along, "router", {});
  const Held held = run(along, "router",
                        {{2, input_door, true},
                         {3, input_start, true},
                         {3.1, input_start, false},
                         {5, input_door, false},
                         {7, input_start, true},
                         {7.1, input_start, false}});
  ASSERT_EQ(held.rests.size(), 1U);
  EXPECT_GT(held.end, whole.end + 4.8) << "neither start behind an open door, nor closing it, is enough";
  test::expect_same_way(held.steps, whole.steps);
}

TEST(OperatorPanel, a_door_that_is_open_before_the_start_refuses_it) {
  test::SessionRun run(test::example_machine("router"), {.line = true});
  run.board().set_switch(input_door, true);
  ASSERT_TRUE(run.turn_until(MachineState::door));
  EXPECT_FALSE(run.session().busy());
  EXPECT_EQ(run.refusal_of(test::start_of(along)), "machine.door-open");
  run.board().set_switch(input_start, true);
  run.pass(Seconds(1));
  run.board().set_switch(input_start, false);
  EXPECT_EQ(run.state(), MachineState::door);
  EXPECT_EQ(run.board().counts().events, 0) << "nothing moves";
  run.board().set_switch(input_door, false);
  ASSERT_TRUE(run.turn_until(MachineState::idle, Seconds(1)));
  const Ticket ticket = run.taken(test::start_of(along));
  run.to_end();
  EXPECT_EQ(run.outcome(ticket), Outcome::done);
}

TEST(OperatorPanel, start_does_nothing_while_hold_is_pressed) {
  const Held held = run(along, "router",
                        {{2, input_hold, true},
                         {3, input_start, true},
                         {3.1, input_start, false},
                         {6, input_hold, false},
                         {7, input_start, true},
                         {7.1, input_start, false}});
  const Held whole = run(along, "router", {});
  EXPECT_GT(held.end, whole.end + 4.8);
}

TEST(OperatorPanel, sees_a_button_whose_message_was_lost) {
  const Held held =
      run(along, "router",
          {{2, input_hold, true}, {2.5, input_hold, false}, {4, input_start, true}, {4.5, input_start, false}}, true);
  ASSERT_EQ(held.rests.size(), 1U);
  EXPECT_LT(held.rests[0], 2.5);
}

TEST(OperatorPanel, waits_where_the_program_allows_no_hold) {
  const Held held = run("G21 G90 M53 P0 G1 F2400\nX240\nM53 P1\nX300\nM2\n", "router", hold_and_start);
  EXPECT_TRUE(held.rests.empty()) << "the hold was called off at 4 s, and the move ends at 6 s";
}

// A jog does not rest on its way: it ends.
TEST(OperatorPanel, ends_a_jog_by_hold_and_by_the_door) {
  for (const BoardInput which : {input_hold, input_door}) {
    test::SessionRun run(test::example_machine("router"), {.line = true});
    run.make_ready();
    Point direction;
    direction[Axis::x] = 1;
    const Ticket ticket =
        run.taken(request::Jog{.way = {.direction = direction, .speed = MmPerSecond(20)}, .lease = Seconds(10)});
    run.pass(Seconds(1));
    run.board().set_switch(which, true);
    run.to_end(Seconds(0.5));
    EXPECT_EQ(run.outcome(ticket), Outcome::stopped);
    run.pass(Seconds(0.5));
    EXPECT_EQ(run.state(), which == input_door ? MachineState::door : MachineState::idle);
    run.expect_at_place();
  }
}

}  // namespace
}  // namespace passo
