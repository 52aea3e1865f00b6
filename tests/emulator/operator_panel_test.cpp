// The emulated Uno's buttons, by their pins: how soon the machine gets slower, and that nothing is lost.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/step_log.hpp"
#include "pipeline/panel_kit.hpp"
#include <gtest/gtest.h>

#include "passo/emulator/emulated_board.hpp"
#include "passo/plant/ideal_plant.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo {
namespace {

using test::StepLog;

struct Ran {
  StepLog::Steps steps;
  int rests = 0;
  double begun = 0;
  double end = 0;  // since then
};

// `pressed`: so long after the start somebody presses hold, for 50 ms; start is pressed two seconds later. Below 0:
// nobody does.
Ran run(double pressed) {
  auto board = EmulatedBoard::start("uno", PASSO_MOTION_UNO);
  EXPECT_TRUE(board);
  IdealPlant plant;
  (*board)->connect(plant);
  StepLog log;
  (*board)->on_step = [&](std::uint64_t cycle, std::size_t motor, bool down) {
    log.add(static_cast<std::int64_t>(cycle), static_cast<unsigned>(motor), down);
  };
  const MachineDescription machine = test::example_machine("uno");
  BoardMachineSession session(machine, **board,
                              {.over_a_line = true,
                               .care = {.answer_within = Seconds(0.1), .patience = Seconds(60)},
                               .greeting = {.session = 1},
                               .start = {.place = Point(), .trust = Trust::commanded}});
  for (int i = 0; i < 1000 && session.state() == MachineState::offline; ++i) session.poll(Seconds(0.02));
  EXPECT_EQ(session.state(), MachineState::idle) << session.trouble_words();
  const auto ticket = session.request(
      request::Start{.program = ProgramReader::from_text("t", "G21 G90 G1 F2400\nX120\nM2\n"), .options = {}});
  EXPECT_TRUE(ticket);
  Ran result;
  result.begun = session.now().value();
  struct Press {
    double at;
    BoardInput which;
    bool closed;
  };
  const Press presses[] = {{pressed, input_hold, true},
                           {pressed + 0.05, input_hold, false},
                           {pressed + 2, input_start, true},
                           {pressed + 2.05, input_start, false}};
  std::size_t next = pressed < 0 ? std::size(presses) : 0;
  Outcome outcome = Outcome::failed;
  while (session.busy()) {
    for (; next < std::size(presses) && session.now().value() - result.begun >= presses[next].at; ++next) {
      plant.set_switch(presses[next].which, presses[next].closed);
    }
    session.poll(Seconds(0.02));
    for (const MachineChange& change : session.take_changes()) {
      if (change.kind == MachineChange::Kind::came_to_rest) ++result.rests;
      if (change.kind == MachineChange::Kind::answered) outcome = change.outcome;
    }
  }
  EXPECT_EQ(outcome, Outcome::done);
  EXPECT_EQ(session.status().position.trust, Trust::counted);
  result.end = session.now().value() - result.begun;
  static_cast<void>((*board)->run(Seconds(0.01)));
  test::expect_within_limits(machine, log.steps);
  result.steps = log.steps;
  return result;
}

TEST(EmulatedPanel, hold_slows_the_machine_soon_and_start_goes_on) {
  const Ran whole = run(-1);
  double longest = 0;
  for (const double pressed : {1.0, 1.013, 1.027, 1.041}) {
    const Ran held = run(pressed);
    EXPECT_EQ(held.rests, 1);
    EXPECT_GT(held.end, whole.end + 1.8);
    test::expect_same_way(held.steps, whole.steps);
    longest = std::max(longest, test::reaction(held.steps[0], 16e6, held.begun + pressed));
  }
  std::printf("from the button's pin to the first step that is late: %.1f ms at most\n", longest * 1000);
  EXPECT_GT(longest, 0.012) << "so long it must be pressed";
  EXPECT_LT(longest, 0.15);
}

}  // namespace
}  // namespace passo
