// The buttons and the door of a board over a line: hold, go on, and nothing is lost.
#include "passo/session/operator_panel.hpp"

#include <cstdio>
#include <string>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/step_log.hpp"
#include "pipeline/panel_kit.hpp"
#include <gtest/gtest.h>

#include "passo/activity/program.hpp"

namespace passo {
namespace {

using test::along;
using test::reaction;
using test::StepLog;
using State = MotionDrive::State;

struct Press {
  double at = 0;
  std::uint16_t which = 0;
  bool closed = true;
};

struct Held {
  StepLog::Steps steps;
  std::vector<double> rests;  // when it came to rest in a hold
  double end = 0;
};

Held run(const std::string& program, const char* name, const std::vector<Press>& presses, bool lose_captured = false) {
  const MachineDescription machine = test::example_machine(name);
  Diagnostics diagnostics;
  Job job(ProgramReader::from_text("t", program), machine, {}, diagnostics, {.line = LineOptions{}});
  StepLog log;
  job.machine().add_observer(log);
  job.line().set_trouble([&](bool to_board, VirtualLine::Bytes bytes) {
    const bool captured = !to_board && bytes[2] == 0x99;
    return captured && lose_captured ? VirtualLine::Bytes() : bytes;
  });
  OperatorPanel panel(job.drive());
  Held held;
  std::size_t next = 0;
  State before = State::running;
  while (job.advance() && job.drive().now() < Seconds(60)) {
    for (; next < presses.size() && job.drive().now() >= Seconds(presses[next].at); ++next) {
      job.machine().set_switch(presses[next].which, presses[next].closed);
    }
    panel.look();
    if (job.drive().state() == State::held && before != State::held) held.rests.push_back(job.drive().now().value());
    before = job.drive().state();
  }
  EXPECT_FALSE(job.link().error());
  EXPECT_EQ(job.drive().state(), State::ended);
  test::expect_within_limits(machine, log.steps);
  held.steps = log.steps;
  held.end = job.drive().now().value();
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
    const double slower = reaction(held.steps[0], clock, 2);
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

TEST(OperatorPanel, a_door_that_is_open_at_the_start_lets_nothing_move) {
  const Held held =
      run(along, "router",
          {{0, input_door, true}, {3, input_door, false}, {4, input_start, true}, {4.1, input_start, false}});
  ASSERT_GE(held.rests.size(), 1U);
  EXPECT_LT(held.rests[0], 1);
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

}  // namespace
}  // namespace passo
