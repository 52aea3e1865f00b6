#include "passo/drive/planner_holds.hpp"

#include "kit/stage_test.hpp"

namespace passo {
namespace {

class PlannerHoldsTest : public testing::Test {
 protected:
  // Lets the planner give motion until it rests in a hold. False: the path has ended before.
  bool comes_to_rest() {
    MotionItem item;
    while (planner.next(item)) {
      const auto* action = std::get_if<Action>(&item);
      if (action != nullptr && action->kind == Action::Kind::feed_hold) return true;
    }
    return false;
  }

  static MotionLimits limits() {
    MotionLimits limits;
    limits.velocity[Axis::x] = MmPerSecond(100);
    limits.acceleration[Axis::x] = MmPerSecond2(500);
    return limits;
  }
  test::ListSource<PathItem> source{
      {Segment{.curve = Curve::line(test::xyz(0, 0), test::xyz(500, 0)), .speed = MmPerSecond(50)}}};
  Planner planner{source, limits()};
  PlannerHolds holds{planner};
};

TEST_F(PlannerHoldsTest, brake_for_each_reason_that_demands_it_and_go_on_after_the_last) {
  holds.change(HoldReason::door, true);
  holds.change(HoldReason::operator_hold, true);
  EXPECT_TRUE(comes_to_rest());
  holds.change(HoldReason::door, false);
  EXPECT_TRUE(comes_to_rest()) << "one reason is left";
  holds.change(HoldReason::operator_hold, false);
  EXPECT_FALSE(comes_to_rest());
}

TEST_F(PlannerHoldsTest, tell_the_planner_again_what_remains) {
  holds.change(HoldReason::drop, true);
  holds.change(HoldReason::door, true);
  EXPECT_TRUE(comes_to_rest());
  holds.end({HoldReason::drop, HoldReason::tap, HoldReason::probe_contact});
  EXPECT_TRUE(holds.has(HoldReason::door));
  EXPECT_TRUE(comes_to_rest());
}

TEST_F(PlannerHoldsTest, note_reasons_at_rest_without_a_word_to_the_planner) {
  holds.set(HoldReason::program_stop);
  EXPECT_TRUE(holds.any_of(lasting_holds));
  EXPECT_FALSE(comes_to_rest());
}

TEST_F(PlannerHoldsTest, have_a_reason_while_the_factors_leave_no_feed) {
  holds.set_feed_override(0.5);
  EXPECT_FALSE(holds.has(HoldReason::zero_feed));
  holds.set_adaptive_feed(0.019);
  EXPECT_TRUE(holds.has(HoldReason::zero_feed)) << "0.0095 in all";
  holds.set_feed_override(2);
  EXPECT_FALSE(holds.has(HoldReason::zero_feed));
}

}  // namespace
}  // namespace passo
