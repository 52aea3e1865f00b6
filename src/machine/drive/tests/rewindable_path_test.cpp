#include "passo/drive/rewindable_path.hpp"

#include "kit/stage_test.hpp"

namespace passo {
namespace {

using test::xyz;

// Lines of 10, 20, 30 mm along X with a dwell behind the second, and one without length that nobody needs.
std::vector<PathItem> three_lines() {
  const auto line = [](double from, double to) {
    return Segment{.curve = Curve::line(xyz(from, 0), xyz(to, 0)), .speed = MmPerSecond(to)};
  };
  return {line(0, 10), line(10, 10), line(10, 30), Action{.kind = Action::Kind::dwell}, line(30, 60)};
}

class RewindablePathTest : public testing::Test {
 protected:
  RewindablePathTest() { path_.keep(); }

  Curve next_curve() {
    PathItem item;
    EXPECT_TRUE(path_.next(item));
    return std::get<Segment>(item).curve;
  }
  // How the planner would hand on the motion over a part of a curve.
  static MotionItem motion(const Curve& curve, double to) {
    PlannedMove move;
    move.segment.curve = curve;
    move.to = Mm(to);
    return move;
  }

  test::ListSource<PathItem> source_{three_lines()};
  RewindablePath path_{source_};
};

TEST_F(RewindablePathTest, hands_on_what_has_length_and_keeps_it) {
  EXPECT_EQ(test::drain(path_).size(), 4U);
  EXPECT_EQ(path_.items_kept(), 4U);
}

TEST_F(RewindablePathTest, keeps_nothing_when_it_is_not_asked_to) {
  test::ListSource<PathItem> source{three_lines()};
  RewindablePath path(source);
  EXPECT_EQ(test::drain(path).size(), 5U);
  EXPECT_EQ(path.items_kept(), 0U);
}

TEST_F(RewindablePathTest, begins_again_amid_a_segment_and_then_goes_on_with_all_that_follows) {
  test::drain(path_);
  path_.rewind({.item = 1, .s = Mm(5)});
  const Curve rest = next_curve();
  EXPECT_EQ(rest.start()[Axis::x], 15);
  EXPECT_EQ(rest.end()[Axis::x], 30);
  EXPECT_EQ(test::drain(path_).size(), 2U) << "the dwell and the last line";
}

TEST_F(RewindablePathTest, says_where_the_path_is_behind_a_motion_also_after_it_was_rewound) {
  const Curve first = next_curve();
  EXPECT_EQ(path_.behind({}, motion(first, 4)), (PathPosition{.item = 0, .s = Mm(4)}));
  EXPECT_EQ(path_.behind({}, motion(first, 10)), (PathPosition{.item = 1}));
  path_.rewind({.item = 0, .s = Mm(4)});
  const Curve rest = next_curve();
  ASSERT_EQ(rest.length(), Mm(6));
  const PathPosition further = path_.behind({.item = 0, .s = Mm(4)}, motion(rest, 3));
  EXPECT_EQ(further, (PathPosition{.item = 0, .s = Mm(7)})) << "on the whole curve, not on its rest";
  path_.rewind(further);
  EXPECT_EQ(next_curve().start()[Axis::x], 7) << "and again";
}

TEST_F(RewindablePathTest, begins_at_a_place_and_counts_from_the_beginning_all_the_same) {
  path_.begin_at({.item = 1, .s = Mm(5)});
  EXPECT_EQ(path_.place(), (PathPosition{.item = 1, .s = Mm(5)}));
  const Curve rest = next_curve();
  EXPECT_EQ(rest.start()[Axis::x], 15);
  EXPECT_EQ(path_.place(), (PathPosition{.item = 2}));
  const PathPosition further = path_.behind({.item = 1, .s = Mm(5)}, motion(rest, 3));
  EXPECT_EQ(further, (PathPosition{.item = 1, .s = Mm(8)}));
  EXPECT_EQ(test::drain(path_).size(), 2U);
  path_.rewind(further);
  EXPECT_EQ(next_curve().start()[Axis::x], 18);
}

TEST_F(RewindablePathTest, hands_on_a_lead_in_before_the_place_and_counts_it) {
  path_.begin_at({.item = 1, .s = Mm(5)},
                 {Action{.kind = Action::Kind::outputs}, Segment{.curve = Curve::line(xyz(0, 9), xyz(15, 0))}});
  PathItem item;
  ASSERT_TRUE(path_.next(item));
  EXPECT_TRUE(std::holds_alternative<Action>(item));
  const Curve way = next_curve();
  EXPECT_EQ(way.end()[Axis::x], 15);
  const PathPosition amid = path_.behind({.item = 2}, motion(way, 3));
  EXPECT_EQ(amid, (PathPosition{.item = 2, .s = Mm(3)}));
  const Curve rest = next_curve();
  EXPECT_EQ(rest.start()[Axis::x], 15);
  EXPECT_EQ(rest.end()[Axis::x], 30);
  EXPECT_EQ(path_.behind({.item = 3}, motion(rest, 3)), (PathPosition{.item = 3, .s = Mm(3)}));
  path_.rewind(amid);
  EXPECT_NEAR(next_curve().length().value(), way.length().value() - 3, 1e-9) << "of the lead-in";
  EXPECT_EQ(next_curve().start()[Axis::x], 15);
  EXPECT_EQ(test::drain(path_).size(), 2U);
}

TEST_F(RewindablePathTest, an_action_is_passed_but_for_a_hold_which_is_no_part_of_it) {
  EXPECT_EQ(path_.behind({.item = 2}, Action{.kind = Action::Kind::dwell}), (PathPosition{.item = 3}));
  const PathPosition amid{.item = 2, .s = Mm(1)};
  EXPECT_EQ(path_.behind(amid, Action{.kind = Action::Kind::feed_hold}), amid);
}

TEST_F(RewindablePathTest, forgets_what_nobody_goes_back_to_but_not_what_is_still_to_come) {
  test::drain(path_);
  path_.forget_before(2);
  EXPECT_EQ(path_.items_kept(), 2U);
  path_.rewind({.item = 2});
  path_.forget_before(4);
  EXPECT_EQ(path_.items_kept(), 2U) << "it was rewound and not handed out again";
  EXPECT_EQ(test::drain(path_).size(), 2U);
}

}  // namespace
}  // namespace passo
