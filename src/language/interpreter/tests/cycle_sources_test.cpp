// Cycles alone: plain values in, operations out, without a program.
#include "../drilling_cycle.hpp"
#include "../lathe_cycle.hpp"
#include "../threading_cycle.hpp"
#include "kit/in_full.hpp"
#include "kit/stage_test.hpp"
#include <gmock/gmock.h>

#include "passo/interpreter/canon.hpp"

namespace passo {
namespace {

using test::xyz;
using testing::ElementsAre;

// As CanonPrinter prints them, without the counter and the N column.
std::vector<std::string> told(Source<Operation>& cycle) {
  CanonPrinter printer;
  std::vector<std::string> calls;
  for (const Operation& operation : test::drain(cycle)) {
    std::string line;
    printer.print(operation, line);
    line = line.substr(line.find_first_of("ABCDEFGHIJKLMOPQRSTUVWXYZ"));
    calls.push_back(line.substr(0, line.find('\n')));
  }
  return calls;
}

template <class What>
std::vector<What> all(Source<Operation>& cycle) {
  std::vector<What> found;
  for (const Operation& operation : test::drain(cycle)) {
    if (const What* what = std::get_if<What>(&operation.what)) found.push_back(*what);
  }
  return found;
}

DrillingPlan two_holes(CodeNumber number) {
  return {.code = number,
          .start = xyz(0, 0, 5),
          .hole = xyz(1, 2, 0),
          .holes = 2,
          .way = xyz(10, 0, 0),
          .initial_height = 5,
          .retract = 1,
          .bottom = -3,
          .path_mode = PathMode::exact_path};
}

TEST(DrillingCycle, goes_to_each_hole_down_and_back_to_where_the_feed_begins) {
  DrillingCycle cycle(two_holes(code(81)), {.line = 7});
  EXPECT_THAT(told(cycle), ElementsAre("STRAIGHT_TRAVERSE(1.0000, 2.0000, 5.0000, 0.0000, 0.0000, 0.0000)",
                                       "STRAIGHT_TRAVERSE(1.0000, 2.0000, 1.0000, 0.0000, 0.0000, 0.0000)",
                                       "STRAIGHT_FEED(1.0000, 2.0000, -3.0000, 0.0000, 0.0000, 0.0000)",
                                       "STRAIGHT_TRAVERSE(1.0000, 2.0000, 1.0000, 0.0000, 0.0000, 0.0000)",
                                       "STRAIGHT_TRAVERSE(11.0000, 2.0000, 1.0000, 0.0000, 0.0000, 0.0000)",
                                       "STRAIGHT_FEED(11.0000, 2.0000, -3.0000, 0.0000, 0.0000, 0.0000)",
                                       "STRAIGHT_TRAVERSE(11.0000, 2.0000, 1.0000, 0.0000, 0.0000, 0.0000)"));
  EXPECT_EQ(cycle.position(), xyz(11, 2, 1));
  Operation more;
  EXPECT_FALSE(cycle.next(more));
}

TEST(DrillingCycle, each_operation_names_the_line_of_the_block) {
  DrillingCycle cycle(two_holes(code(84)), {.line = 7, .line_number = 40});
  for (const Operation& operation : test::drain(cycle)) {
    EXPECT_EQ(operation.source.line, 7U);
    EXPECT_EQ(operation.source.line_number, 40);
  }
}

TEST(DrillingCycle, between_holes_it_goes_back_to_the_first_height_where_g98_says_so) {
  DrillingPlan plan = two_holes(code(81));
  plan.returns_to_initial = true;
  DrillingCycle cycle(plan, {});
  std::vector<double> between;
  for (const auto& move : all<operation::StraightTraverse>(cycle)) between.push_back(move.end[Axis::z]);
  EXPECT_THAT(between, ElementsAre(5, 1, 5, 5, 1, 5));
}

TEST(DrillingCycle, a_path_mode_that_is_no_exact_path_is_put_back) {
  DrillingPlan plan = two_holes(code(81));
  plan.path_mode = PathMode::continuous;
  plan.tolerance = {.path = Mm(0.1), .merge = Mm(0.02)};
  DrillingCycle cycle(plan, {});
  const auto modes = all<operation::SetPathMode>(cycle);
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_EQ(modes[0].mode, PathMode::exact_path);
  EXPECT_EQ(modes[1].mode, PathMode::continuous);
  EXPECT_EQ(modes[1].tolerance, Mm(0.1));
}

// The longest steps of all, and more holes than any memory of moves would hold.
TEST(DrillingCycle, gives_any_number_of_holes_out_of_little_memory) {
  const std::int32_t holes = test::fewer(100'000);
  for (const CodeNumber number :
       {code(73), code(74), code(81), code(82), code(83), code(84), code(85), code(86), code(87), code(88), code(89)}) {
    DrillingPlan plan = two_holes(number);
    plan.holes = holes;
    plan.initial_height = 0;
    plan.peck = 1.5;
    plan.aside = xyz(0.5, 0, 0);
    plan.path_mode = PathMode::exact_stop;
    DrillingCycle cycle(plan, {});
    std::size_t count = 0;
    for (Operation operation; cycle.next(operation);) ++count;
    EXPECT_GE(count, 3U * static_cast<std::size_t>(holes));
    EXPECT_NEAR(cycle.position()[Axis::x], 1 + 10.0 * (holes - 1), 1e-3);
  }
  static_assert(sizeof(DrillingCycle) < 4096);
}

TEST(DrillingCycle, holes_on_a_circle_follow_each_other_by_an_angle) {
  DrillingPlan plan = two_holes(code(81));
  plan.hole = xyz(4, 0, 0);
  plan.way.reset();
  plan.polar = PolarWay{.radius = 0, .angle = 1.5707963267948966};
  plan.holes = 4;
  DrillingCycle cycle(plan, {});
  const auto feeds = all<operation::StraightFeed>(cycle);
  ASSERT_EQ(feeds.size(), 4U);
  EXPECT_NEAR(feeds[1].end[Axis::y], 4, 1e-12);
  EXPECT_NEAR(feeds[2].end[Axis::x], -4, 1e-12);
  EXPECT_FALSE(cycle.stuck());
}

TEST(DrillingCycle, breaks_off_at_the_origin_where_there_is_no_angle) {
  DrillingPlan plan = two_holes(code(81));
  plan.hole = xyz(4, 0, 0);
  plan.way.reset();
  plan.polar = PolarWay{.radius = -4, .angle = 0};
  plan.holes = 4;
  DrillingCycle cycle(plan, {});
  EXPECT_EQ(all<operation::StraightFeed>(cycle).size(), 2U);
  EXPECT_TRUE(cycle.stuck());
}

ThreadingPlan outside_thread() {
  return {.start = xyz(12, 0, 0),
          .end = xyz(12, 0, -20),
          .outward = 1,
          .crest = 2,
          .first_cut = 0.25,
          .full_depth = 1,
          .pitch = 1.5};
}

TEST(ThreadingCycle, cuts_deeper_pass_by_pass_and_ends_behind_the_thread) {
  ThreadingPlan plan = outside_thread();
  plan.spring_passes = 1;
  ThreadingCycle cycle(plan, {});
  std::vector<double> bottoms;
  for (const auto& move : all<operation::StraightFeed>(cycle)) bottoms.push_back(move.end[Axis::x]);
  // The drive line, the crest 2 below it, and then a quarter more each time; the last one and its spring pass at K.
  EXPECT_THAT(bottoms, ElementsAre(9.75, 9.5, 9.25, 9, 9));
  EXPECT_EQ(cycle.position(), xyz(12, 0, -20));
}

TEST(ThreadingCycle, is_in_step_with_the_spindle_while_it_cuts_and_no_longer) {
  ThreadingCycle cycle(outside_thread(), {});
  bool in_step = false;
  for (const Operation& operation : test::drain(cycle)) {
    if (std::holds_alternative<operation::StartSpeedFeedSync>(operation.what)) in_step = true;
    if (std::holds_alternative<operation::StopSpeedFeedSync>(operation.what)) in_step = false;
    EXPECT_EQ(in_step, std::holds_alternative<operation::StraightFeed>(operation.what) ||
                           std::holds_alternative<operation::StartSpeedFeedSync>(operation.what));
  }
}

TEST(ThreadingCycle, depths_of_a_program_in_inches_are_millimetres_here) {
  ThreadingPlan plan = outside_thread();
  plan.unit = 25.4;
  ThreadingCycle cycle(plan, {});
  EXPECT_NEAR(all<operation::StraightFeed>(cycle).back().end[Axis::x], 12 - 3 * 25.4, 1e-9);
}

// A shaft of radius 5 with a shoulder of 8 at Z -10, out of a bar of 10.
LatheContour shoulder() {
  LatheContour contour;
  const LathePoint points[] = {{0, 10}, {0, 5}, {-10, 5}, {-10, 8}, {-20, 8}};
  for (std::size_t i = 1; i < std::size(points); ++i) {
    LatheSegment segment;
    segment.start = points[i - 1];
    segment.end = points[i];
    contour.segments.push_back(segment);
  }
  contour.orient();
  return contour;
}

TEST(LatheCycle, roughing_stays_out_of_the_part) {
  const LatheRoughing cuts(shoulder(), LatheRoughing::Extent::everything, 1, 0.5);
  LatheCycle cycle({.cuts = cuts, .start = xyz(10, 3, 0)}, {.line = 4});
  int feeds = 0;
  for (const auto& feed : all<operation::StraightFeed>(cycle)) {
    ++feeds;
    EXPECT_GE(feed.end[Axis::x], (feed.end[Axis::z] < -10 - 1e-9 ? 8 : 5) - 1e-9);
    EXPECT_EQ(feed.end[Axis::y], 3);  // stays
  }
  EXPECT_GT(feeds, 5);
  EXPECT_EQ(cycle.fault(), LatheFault::none);
}

TEST(LatheCycle, finishing_follows_the_contour_in_the_machines_units) {
  LatheCycle cycle({.cuts = LatheFinishing(shoulder(), 0, 0, 1), .start = xyz(254, 0, 0), .unit = 25.4}, {});
  std::vector<double> heights;
  for (const auto& feed : all<operation::StraightFeed>(cycle)) heights.push_back(feed.end[Axis::x] / 25.4);
  EXPECT_THAT(heights, ElementsAre(testing::DoubleEq(5), testing::DoubleEq(8), testing::DoubleEq(8)));
  EXPECT_EQ(cycle.last_motion(), code(1));
}

TEST(LatheCycle, says_why_it_broke_off) {
  LatheCycle cycle({.cuts = LatheFinishing(shoulder(), 1e9, 1e9, 1), .start = xyz(10, 0, 0)}, {});
  (void)test::drain(cycle);
  EXPECT_NE(cycle.fault(), LatheFault::none);
}

}  // namespace
}  // namespace passo
