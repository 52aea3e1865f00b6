// Single block and optional stop: the machine rests after each line, on the path and to the step, and the way is the
// same as without.
#include <string>

#include "pipeline/session_kit.hpp"

namespace passo {
namespace {

using test::SessionRun;
using test::start_of;

constexpr const char* four_lines = "G21 G90 G1 F1200\nX10\nX10 Y10\nX0 Y10\nX0 Y0\nM2\n";
constexpr int lines_with_motion = 4;

class SingleBlock : public testing::TestWithParam<bool> {
 protected:
  SingleBlock() : run_(test::short_router(), {.line = GetParam()}) { run_.make_ready(); }

  bool rests_at_line() {
    return run_.turn_until([&] { return run_.rests() && run_.session().status().holds.has(HoldReason::line_end); },
                           Seconds(20));
  }
  // Resumes until the end. Returns how often the machine has rested.
  int rests_to_end() {
    int rests = 0;
    for (; run_.session().busy(); ++rests) {
      const auto stands = [&] { return !run_.session().busy() || run_.state() == MachineState::hold; };
      EXPECT_TRUE(run_.turn_until(stands, Seconds(20)));
      if (!run_.session().busy()) break;
      EXPECT_TRUE(rests_at_line());
      run_.taken(request::Resume{});
    }
    return rests;
  }
  Point place() { return run_.session().status().ahead; }

  SessionRun run_;
};
INSTANTIATE_TEST_SUITE_P(, SingleBlock, testing::Bool(),
                         [](const auto& line) { return std::string(line.param ? "over_a_line" : "direct"); });

TEST_P(SingleBlock, rests_after_each_line_and_the_way_is_the_same) {
  SessionRun whole(test::short_router(), {.line = GetParam()});
  whole.make_ready();
  whole.taken(start_of(four_lines));
  whole.to_end();

  run_.taken(request::ChooseStops{.single_block = true});
  const Ticket program = run_.taken(start_of(four_lines));
  ASSERT_TRUE(rests_at_line());
  EXPECT_NEAR(place()[Axis::x], 10, 0.05);
  EXPECT_NEAR(place()[Axis::y], 0, 0.05);
  EXPECT_EQ(rests_to_end(), lines_with_motion);
  EXPECT_EQ(run_.outcome(program), Outcome::done);
  test::expect_same_way(run_.log.steps, whole.log.steps);
  run_.expect_at_place();
}

TEST_P(SingleBlock, that_is_chosen_amid_motion_rests_at_once_and_then_at_the_next_end) {
  const Ticket program = run_.taken(start_of(four_lines));
  run_.pass(Seconds(0.3));
  run_.taken(request::ChooseStops{.single_block = true});
  ASSERT_TRUE(rests_at_line());
  EXPECT_LT(place()[Axis::x], 9);
  run_.taken(request::Resume{});
  EXPECT_EQ(run_.state(), MachineState::run);
  ASSERT_TRUE(rests_at_line());
  EXPECT_NEAR(place()[Axis::x], 10, 0.05);
  EXPECT_EQ(rests_to_end(), lines_with_motion);
  EXPECT_EQ(run_.outcome(program), Outcome::done);
}

TEST_P(SingleBlock, that_is_chosen_in_a_hold_counts_from_the_line_at_hand) {
  run_.taken(start_of(four_lines));
  run_.pass(Seconds(0.3));
  run_.taken(request::Hold{});
  ASSERT_TRUE(run_.turn_until([&] { return run_.rests(); }));
  run_.taken(request::ChooseStops{.single_block = true});
  run_.taken(request::Resume{});
  ASSERT_TRUE(rests_at_line());
  EXPECT_NEAR(place()[Axis::x], 10, 0.05);
  EXPECT_EQ(rests_to_end(), lines_with_motion);
}

TEST_P(SingleBlock, that_is_given_up_lets_the_program_go_on_to_its_end) {
  run_.taken(request::ChooseStops{.single_block = true});
  const Ticket program = run_.taken(start_of(four_lines));
  ASSERT_TRUE(rests_at_line());
  run_.taken(request::ChooseStops{.single_block = false});
  EXPECT_EQ(run_.state(), MachineState::hold) << "somebody has to resume it";
  run_.taken(request::Resume{});
  run_.to_end();
  EXPECT_EQ(run_.outcome(program), Outcome::done);
}

TEST_P(SingleBlock, goes_through_probe_moves_and_stops) {
  run_.taken(request::ChooseStops{.single_block = true});
  const Ticket program = run_.taken(start_of("G21 G90 G1 F1200\nX5\nG38.3 Z-3 F300\nG1 X8\nM0\nX9\nM2\n"));
  int turns = 0;
  for (; run_.session().busy() && turns < 20; ++turns) {
    ASSERT_TRUE(
        run_.turn_until([&] { return !run_.session().busy() || run_.state() == MachineState::hold; }, Seconds(20)));
    if (!run_.session().busy()) break;
    ASSERT_TRUE(run_.turn_until([&] { return run_.rests(); }));
    run_.taken(run_.session().status().waits_for ? Request(request::OperatorDone{}) : Request(request::Resume{}));
  }
  EXPECT_EQ(turns, 5) << "X5, the probe move, X8, M0 and X9";
  EXPECT_EQ(run_.outcome(program), Outcome::done);
  run_.expect_at_place();
}

TEST_P(SingleBlock, an_optional_stop_is_up_to_the_operator) {
  EXPECT_TRUE(run_.session().status().stops.optional_stop);
  run_.taken(request::ChooseStops{.optional_stop = false});
  const Ticket program = run_.taken(start_of("G21 G90 G1 F1200\nX5\nM1\nX10\nM0\nX12\nM2\n"));
  ASSERT_TRUE(run_.turn_until(MachineState::hold, Seconds(20)));
  EXPECT_EQ(run_.session().status().waits_for->kind, Action::Kind::program_stop);
  run_.taken(request::OperatorDone{});
  run_.to_end();
  EXPECT_EQ(run_.outcome(program), Outcome::done);
}

}  // namespace
}  // namespace passo
