#include "passo/session/position_tracker.hpp"

#include "kit/example_machine.hpp"
#include <gtest/gtest.h>

#include "passo/activity/stage_options.hpp"
#include "passo/session/live_position.hpp"

namespace passo {
namespace {

class TrackedPlaceTest : public testing::Test {
 protected:
  static Point at(double x, double y) {
    Point point;
    point[Axis::x] = x;
    point[Axis::y] = y;
    return point;
  }
  // The machine stands there, and the board's counts begin at 1000.
  void stand_at(const Point& place, Trust trust) {
    for (std::int32_t& count : board.positions) count = 1000;
    tracked.stand_at({.place = place, .trust = trust}, &board);
  }
  // A motion ends there; the board has counted `missing` steps of X less.
  void move_to(const Point& place, int missing = 0) {
    const MotorSteps from = steps_at(machine, tracked.position().place, {});
    const MotorSteps to = steps_at(machine, place, {});
    BoardPosition fresh;
    fresh.motors.fill(0x8000);  // as after a hello: on whole steps
    BoardPosition end = tracked.on_board().value_or(fresh);
    for (std::size_t m = 0; m < machine.axes.size(); ++m) {
      end.set_steps(m, to[m]);
      board.positions[m] += static_cast<std::int32_t>(to[m] - from[m]);
    }
    board.positions[0] -= missing;
    tracked.rest_at(end, {});
  }

  MachineDescription machine = test::example_machine("router");
  BoardStatus board;
  PositionTracker tracked{machine, {}};
};

TEST_F(TrackedPlaceTest, is_counted_when_the_board_has_made_each_step) {
  stand_at(at(10, 20), Trust::commanded);
  move_to(at(30, 5));
  EXPECT_TRUE(tracked.agrees_with(&board));
  EXPECT_EQ(tracked.position().trust, Trust::counted);
  EXPECT_NEAR(tracked.position().place[Axis::x], 30, 0.01);
  EXPECT_FALSE(tracked.mismatch());
}

TEST_F(TrackedPlaceTest, is_lost_once_when_counts_differ) {
  stand_at(at(0, 0), Trust::homed);
  move_to(at(30, 5), 3);
  EXPECT_FALSE(tracked.agrees_with(&board));
  EXPECT_EQ(tracked.position().trust, Trust::unknown);
  EXPECT_TRUE(tracked.position().is_lost);
  ASSERT_TRUE(tracked.mismatch());
  EXPECT_EQ(tracked.mismatch()->counted - tracked.mismatch()->commanded, -3);
  move_to(at(40, 5));
  EXPECT_TRUE(tracked.agrees_with(&board)) << "compared from the mismatch on";
  EXPECT_EQ(tracked.position().trust, Trust::unknown);
}

TEST_F(TrackedPlaceTest, without_a_board_that_counts_is_what_was_commanded) {
  tracked.stand_at({.place = at(1, 1), .trust = Trust::commanded}, nullptr);
  move_to(at(2, 2));
  EXPECT_TRUE(tracked.agrees_with(nullptr));
  EXPECT_EQ(tracked.position().trust, Trust::commanded);
  EXPECT_FALSE(tracked.zero_counts());
}

TEST_F(TrackedPlaceTest, that_was_doubted_is_proved_by_a_board_that_went_on_counting) {
  stand_at(at(10, 10), Trust::homed);
  tracked.doubt();
  tracked.doubt();
  EXPECT_EQ(tracked.position().trust, Trust::unknown);
  const MotorSteps from = steps_at(machine, at(10, 10), {});
  const MotorSteps to = steps_at(machine, at(12, 10), {});
  board.positions[0] += static_cast<std::int32_t>(to[0] - from[0]);
  tracked.find_again(board, true);
  EXPECT_EQ(tracked.position().trust, Trust::homed);
  EXPECT_FALSE(tracked.position().is_lost);
  EXPECT_NEAR(tracked.position().place[Axis::x], 12, 0.01);
}

TEST_F(TrackedPlaceTest, that_was_doubted_stays_lost_after_a_reset_of_the_board) {
  stand_at(at(10, 10), Trust::homed);
  tracked.doubt();
  tracked.find_again(board, false);
  tracked.find_again(board, true);
  EXPECT_EQ(tracked.position().trust, Trust::unknown);
}

TEST(LivePosition, tells_the_speed_between_two_answers) {
  LivePosition place;
  Point point;
  place.hear(point, Seconds(1));
  point[Axis::x] = 3;
  place.hear(point, Seconds(1.5));
  EXPECT_NEAR(place.speed().value(), 6, 1e-12);
  EXPECT_FALSE(place.is_news(Seconds(1.5)));
  place.rest_at(point);
  EXPECT_EQ(place.speed(), MmPerSecond(0));
}

TEST(LivePosition, is_asked_for_after_the_last_question_or_answer) {
  LivePosition place;
  place.on_asked(Seconds(1));
  EXPECT_FALSE(place.is_due(Seconds(1.01), {}, Seconds(0.02)));
  EXPECT_TRUE(place.is_due(Seconds(1.03), {}, Seconds(0.02)));
  EXPECT_FALSE(place.is_due(Seconds(1.03), Seconds(1.02), Seconds(0.02)));
}

}  // namespace
}  // namespace passo
