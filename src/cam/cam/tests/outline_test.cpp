#include "passo/cam/outline.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/cam/bulge.hpp"

namespace passo {
namespace {

DrawnPoint xy(double x, double y) {
  return {to_nanometres(Mm(x)), to_nanometres(Mm(y))};
}
Nanometres lengthy(double mm) {
  return to_nanometres(Mm(mm));
}
DrawnPath open_line(std::vector<PathPoint> points) {
  const auto line = static_cast<std::uint32_t>(points.front().at.y.count / 1'000'000 + 3);
  return {.points = std::move(points), .is_closed = false, .width = {}, .layer = 0, .line = line};
}
// 40 x 30 mm, drawn as four lines in any order and direction, with an opening of 6 mm.
Drawing board_drawing(double gap = 0) {
  Drawing drawing{.file = "edge.dxf", .layers = {"Edge"}, .holes = {}, .paths = {}, .notes = {}};
  drawing.paths.push_back(open_line({{xy(0, 0)}, {xy(40, 0)}}));
  drawing.paths.push_back(open_line({{xy(0, 30)}, {xy(0, 0)}}));
  drawing.paths.push_back(open_line({{xy(40, 30 - gap)}, {xy(40, 0)}}));
  drawing.paths.push_back(open_line({{xy(40, 30)}, {xy(0, 30)}}));
  drawing.holes.push_back({xy(20, 15), lengthy(6), 0, 9});
  return drawing;
}
struct Outlined {
  EdgeLoops loops;
  Region board;
  OutlinePlan plan;
  Diagnostics findings;
};
Outlined outlined(const Drawing& drawing, const OutlineOptions& options, double join = 0.1) {
  Outlined result;
  result.loops = edge_loops(drawing, lengthy(join), result.findings);
  result.board = board_within(result.loops);
  if (!result.findings.any_error()) result.plan = plan_outline(result.board, options, result.findings);
  return result;
}
const MillRun& run_of(const Outlined& result, std::size_t index) {
  return result.plan.mill.tools.at(0).runs.at(index);
}

TEST(EdgeLoops, joins_lines_in_any_order_and_direction) {
  const Outlined result = outlined(board_drawing(), {});
  EXPECT_FALSE(result.findings.any_error());
  EXPECT_EQ(result.loops.loops.size(), 2U);
  EXPECT_EQ(result.loops.joined, 0U);
  EXPECT_NEAR(area_mm2(result.board), 1200 - 9 * M_PI, 0.01);
}

TEST(EdgeLoops, closes_gaps_within_the_tolerance_and_tells_wider_ones) {
  const Outlined joined = outlined(board_drawing(0.08), {});
  EXPECT_FALSE(joined.findings.any_error());
  EXPECT_EQ(joined.loops.joined, 1U);
  EXPECT_EQ(joined.loops.widest_joined, lengthy(0.08));
  const Outlined open = outlined(board_drawing(0.25), {});
  ASSERT_EQ(open.findings.errors(), 2U);
  EXPECT_EQ(open.findings.all()[0].code, "outline.open");
  EXPECT_THAT(open.findings.all()[0].expected, testing::HasSubstr("--join 0.25mm"));
}

TEST(EdgeLoops, lines_drawn_twice_count_once) {
  Drawing drawing = board_drawing();
  drawing.paths.push_back(open_line({{xy(40, 0)}, {xy(0, 0)}}));
  EXPECT_FALSE(outlined(drawing, {}).findings.any_error());
}

// Nine lines of a demonstration board of KiCad: two ends at one place, and a tree of places that did not see it.
TEST(EdgeLoops, ends_at_one_place_meet_wherever_it_lies) {
  Drawing drawing{.file = "edge.dxf", .layers = {"Edge"}, .holes = {}, .paths = {}, .notes = {}};
  for (const auto& [from, to] :
       {std::pair(xy(172.085, 133.35), xy(194.945, 133.35)), std::pair(xy(90.805, 140.97), xy(90.805, 142.494)),
        std::pair(xy(79.375, 133.35), xy(79.375, 34.29)), std::pair(xy(79.375, 34.29), xy(194.945, 34.29)),
        std::pair(xy(194.945, 133.35), xy(194.945, 34.29)), std::pair(xy(90.805, 142.494), xy(172.085, 142.494)),
        std::pair(xy(90.805, 133.35), xy(90.805, 140.97)), std::pair(xy(172.085, 142.494), xy(172.085, 133.35)),
        std::pair(xy(90.805, 133.35), xy(79.375, 133.35))}) {
    drawing.paths.push_back(open_line({{from}, {to}}));
  }
  const Outlined result = outlined(drawing, {});
  EXPECT_FALSE(result.findings.any_error()) << render(result.findings, false);
  EXPECT_EQ(result.loops.loops.size(), 1U);
}

// As EAGLE draws a rounded corner: part of another path again, and forth and back.
TEST(EdgeLoops, parts_drawn_twice_or_forth_and_back_count_once) {
  const double quarter = std::tan(M_PI / 8);
  Drawing drawing{.file = "edge.dxf", .layers = {"Edge"}, .holes = {}, .paths = {}, .notes = {}};
  drawing.paths.push_back(open_line({{xy(0, 0)}, {xy(36, 0), quarter}, {xy(40, 4)}, {xy(40, 30)}}));
  drawing.paths.push_back(open_line({{xy(40, 4), -quarter}, {xy(36, 0)}}));
  drawing.paths.push_back(open_line({{xy(40, 30)}, {xy(4, 30), quarter}, {xy(0, 26), -quarter}, {xy(4, 30)}}));
  drawing.paths.push_back(open_line({{xy(0, 26)}, {xy(0, 13)}, {xy(0, 26)}}));
  drawing.paths.push_back(open_line({{xy(0, 0)}, {xy(0, 13)}}));
  const Outlined result = outlined(drawing, {});
  EXPECT_FALSE(result.findings.any_error()) << render(result.findings, false);
  EXPECT_EQ(result.loops.loops.size(), 1U);
  EXPECT_NEAR(area_mm2(result.board), 1200 - 2 * (16 - 4 * M_PI), 0.01);
}

// A slot of loose lines and arcs. Its arcs are drawn again, in the other direction and with the roundings of a program.
TEST(EdgeLoops, arcs_drawn_twice_count_once_in_spite_of_roundings) {
  Drawing drawing{.file = "edge.dxf", .layers = {"Edge"}, .holes = {}, .paths = {}, .notes = {}};
  drawing.paths.push_back(open_line({{xy(0, 0)}, {xy(40, 0)}}));
  drawing.paths.push_back(open_line({{xy(40, 0), 1}, {xy(40, 10)}}));
  drawing.paths.push_back(open_line({{xy(40, 10)}, {xy(0, 10)}}));
  drawing.paths.push_back(open_line({{xy(0, 10), 1}, {xy(0, 0)}}));
  drawing.paths.push_back(open_line({{xy(40.0003, 10.0002), -1}, {xy(39.9998, -0.0004)}}));
  drawing.paths.push_back(open_line({{xy(0.0001, 10.0005), 1}, {xy(-0.0004, 0.0001)}}));
  const Outlined result = outlined(drawing, {});
  EXPECT_FALSE(result.findings.any_error()) << render(result.findings, false);
  EXPECT_EQ(result.loops.loops.size(), 1U);
  EXPECT_NEAR(area_mm2(result.board), 400 + 25 * M_PI, 0.01);
}

// Two arcs between the same ends, one on each side, are a closed contour.
TEST(EdgeLoops, arcs_with_common_ends_are_different_arcs) {
  Drawing drawing{.file = "edge.dxf", .layers = {"Edge"}, .holes = {}, .paths = {}, .notes = {}};
  drawing.paths.push_back(open_line({{xy(0, 0), 0.3}, {xy(40, 0)}}));
  drawing.paths.push_back(open_line({{xy(40, 0), 0.3}, {xy(0, 0)}}));
  const Outlined result = outlined(drawing, {});
  EXPECT_FALSE(result.findings.any_error()) << render(result.findings, false);
  EXPECT_EQ(result.loops.loops.size(), 1U);
}

TEST(EdgeLoops, a_line_of_a_closed_outline_may_be_drawn_again) {
  Drawing drawing{.file = "edge.gbr", .layers = {"0"}, .holes = {}, .paths = {}, .notes = {}};
  DrawnPath whole = open_line({{xy(0, 0)}, {xy(40, 0)}, {xy(40, 30)}, {xy(0, 30)}});
  whole.is_closed = true;
  drawing.paths = {whole, open_line({{xy(40, 0)}, {xy(0, 0)}})};
  const Outlined again = outlined(drawing, {.cutter = lengthy(2)});
  EXPECT_FALSE(again.findings.any_error());
  EXPECT_EQ(again.loops.loops.size(), 1U);
  drawing.paths[1] = open_line({{xy(10, 30)}, {xy(20, 30)}});  // a part of a side
  EXPECT_FALSE(outlined(drawing, {.cutter = lengthy(2)}).findings.any_error());
}

DrawnPath closed_line(std::vector<PathPoint> points) {
  DrawnPath path = open_line(std::move(points));
  path.is_closed = true;
  return path;
}

TEST(EdgeLoops, circles_drawn_twice_count_once) {
  Drawing drawing = board_drawing();
  drawing.holes.push_back(drawing.holes.front());
  // The same circle as a path, clockwise, and in four arcs that begin elsewhere.
  drawing.paths.push_back(closed_line({{xy(20, 18), -1}, {xy(20, 12), -1}}));
  const double quarter = std::tan(M_PI / 8);
  const double side = 3 * std::sqrt(0.5);
  drawing.paths.push_back(closed_line({{xy(20 + side, 15 + side), quarter},
                                       {xy(20 - side, 15 + side), quarter},
                                       {xy(20 - side, 15 - side), quarter},
                                       {xy(20 + side, 15 - side), quarter}}));
  const Outlined result = outlined(drawing, {});
  EXPECT_FALSE(result.findings.any_error());
  EXPECT_EQ(result.loops.loops.size(), 2U);
  EXPECT_EQ(result.loops.repeated, 3U);
  EXPECT_NEAR(area_mm2(result.board), 1200 - 9 * M_PI, 0.01);
}

TEST(EdgeLoops, closed_contours_drawn_twice_count_once_in_any_direction) {
  const double quarter = std::tan(M_PI / 8);
  const std::vector<PathPoint> rounded = {{xy(4, 0)},   {xy(36, 0), quarter}, {xy(40, 4)}, {xy(40, 26), quarter},
                                          {xy(36, 30)}, {xy(4, 30), quarter}, {xy(0, 26)}, {xy(0, 4), quarter}};
  const std::vector<PathPoint> backwards = {{xy(40, 4), -quarter}, {xy(36, 0)}, {xy(4, 0), -quarter},   {xy(0, 4)},
                                            {xy(0, 26), -quarter}, {xy(4, 30)}, {xy(36, 30), -quarter}, {xy(40, 26)}};
  const std::vector<PathPoint> sharp = {{xy(0, 0)}, {xy(40, 0)}, {xy(40, 30)}, {xy(0, 30)}};
  const std::vector<PathPoint> sharp_backwards = {{xy(0, 0)}, {xy(0, 30)}, {xy(40, 30)}, {xy(40, 0)}};
  const double corners = 4 * 16 - 16 * M_PI;
  for (const auto& [first, second, mm2] :
       {std::tuple(rounded, rounded, 1200 - corners), std::tuple(rounded, backwards, 1200 - corners),
        std::tuple(sharp, sharp, 1200.0), std::tuple(sharp, sharp_backwards, 1200.0)}) {
    Drawing drawing{.file = "edge.dxf", .layers = {"Edge"}, .holes = {}, .paths = {}, .notes = {}};
    drawing.paths = {closed_line(first), closed_line(second)};
    const Outlined closed = outlined(drawing, {});
    EXPECT_EQ(closed.loops.loops.size(), 1U);
    EXPECT_EQ(closed.loops.repeated, 1U);
    EXPECT_NEAR(area_mm2(closed.board), mm2, 0.01);
    EXPECT_NEAR(area_mm2(enclosed_by(closed.loops.loops)), mm2, 0.02);
    // As closed paths that are drawn as open ones: the pieces are the same.
    for (DrawnPath& path : drawing.paths) {
      path.is_closed = false;
      path.points.push_back({path.points.front().at, 0});
    }
    EXPECT_EQ(outlined(drawing, {}).loops.loops.size(), 1U);
  }
}

// Neither the same first side nor the same box makes two contours the same.
TEST(EdgeLoops, contours_that_share_a_side_or_a_box_are_two) {
  Drawing drawing{.file = "edge.dxf", .layers = {"Edge"}, .holes = {}, .paths = {}, .notes = {}};
  drawing.paths = {closed_line({{xy(0, 0)}, {xy(40, 0)}, {xy(40, 30)}, {xy(0, 30)}}),
                   closed_line({{xy(0, 0)}, {xy(40, 0)}, {xy(40, -10)}, {xy(0, -10)}}),
                   closed_line({{xy(20, 0)}, {xy(40, 15)}, {xy(20, 30)}, {xy(0, 15)}})};
  const Outlined result = outlined(drawing, {});
  EXPECT_EQ(result.loops.loops.size(), 3U);
  EXPECT_EQ(result.loops.repeated, 0U);
}

TEST(EdgeLoops, lines_may_overlap) {
  Drawing drawing{.file = "edge.gbr", .layers = {"0"}, .holes = {}, .paths = {}, .notes = {}};
  for (const auto& [from, to] :
       {std::pair(xy(0, 0), xy(30, 0)), std::pair(xy(40, 0), xy(20, 0)), std::pair(xy(40, 0), xy(40, 30)),
        std::pair(xy(40, 30), xy(0, 30)), std::pair(xy(0, 30), xy(0, 0)), std::pair(xy(0, 25), xy(0, 5))}) {
    drawing.paths.push_back(open_line({{from}, {to}}));
  }
  const Outlined result = outlined(drawing, {.cutter = lengthy(2)});
  EXPECT_FALSE(result.findings.any_error()) << render(result.findings, false);
  EXPECT_EQ(area_mm2(result.board), 1200);
}

TEST(EdgeLoops, a_line_within_the_board_is_a_slot_and_no_join_is_advised_that_loses_it) {
  Drawing drawing = board_drawing();
  drawing.paths.push_back(open_line({{xy(5, 5)}, {xy(30, 5)}}));
  Diagnostics findings;
  const EdgeLoops loops = edge_loops(drawing, lengthy(0.1), findings, OpenRows::slots);
  EXPECT_FALSE(findings.any_error());
  ASSERT_EQ(loops.open.size(), 1U);
  const OutlinePlan plan = plan_outline(
      board_within(loops),
      {.cutter = lengthy(2), .depth = lengthy(-1), .step = lengthy(0.5), .slots = {{xy(5, 5), xy(30, 5)}}}, findings);
  EXPECT_EQ(plan.slots, 1U);
  const MillRun& run = plan.mill.tools.at(0).runs.at(0);
  ASSERT_EQ(run.size(), 4U);
  EXPECT_EQ(run[3].at, xy(5, 5));
  EXPECT_EQ(run[3].z, lengthy(-1));
  Diagnostics refused;
  edge_loops(drawing, lengthy(0.1), refused);
  ASSERT_EQ(refused.errors(), 1U);
  EXPECT_EQ(refused.all()[0].message, "the outline is open: it ends at X5 Y5 and at X30 Y5 mm");
  EXPECT_EQ(refused.all()[0].expected, "a closed line");
}

TEST(EdgeLoops, a_loop_in_an_opening_is_board_again) {
  Drawing drawing = board_drawing();
  drawing.holes.push_back({xy(20, 15), lengthy(2), 0, 10});
  EXPECT_NEAR(area_mm2(outlined(drawing, {.cutter = lengthy(1)}).board), 1200 - 9 * M_PI + M_PI, 0.01);
}

TEST(Outline, cuts_the_opening_first_in_even_turns_and_takes_nothing_of_the_board) {
  const Outlined result =
      outlined(board_drawing(), {.cutter = lengthy(2), .depth = lengthy(-1.8), .step = lengthy(0.5)});
  ASSERT_EQ(result.plan.mill.tools.at(0).runs.size(), 2U);
  EXPECT_EQ(result.plan.outsides, 1U);
  EXPECT_EQ(result.plan.openings, 1U);
  EXPECT_EQ(result.plan.lost_mm2, 0);
  for (const MillPoint& point : run_of(result, 0)) EXPECT_NEAR(distance_nm(point.at, xy(20, 15)), 2e6, 2500);
  EXPECT_EQ(run_of(result, 1).back().z, lengthy(-1.8));
  const double once = 2 * M_PI * 1.998 + 140 + 2 * M_PI * 1.002;
  EXPECT_NEAR(lengths_of(result.plan.mill.tools[0], {}).milled_nm / 1e6, 4 * once + 2 * (1.8 - 0.45), 0.05);
}

// The arcs of the drawing stay arcs, about the same centre.
TEST(Outline, arcs_of_the_edge_are_arcs_of_the_way) {
  const double quarter = std::tan(M_PI / 8);
  Drawing drawing{.file = "edge.dxf", .layers = {"0"}, .holes = {}, .paths = {}, .notes = {}};
  DrawnPath path = open_line({{xy(5, 0)},
                              {xy(35, 0), quarter},
                              {xy(40, 5)},
                              {xy(40, 25), quarter},
                              {xy(35, 30)},
                              {xy(5, 30), quarter},
                              {xy(0, 25)},
                              {xy(0, 5), quarter}});
  path.is_closed = true;
  drawing.paths.push_back(path);
  const Outlined result = outlined(drawing, {.cutter = lengthy(2), .depth = lengthy(-1), .step = lengthy(1)});
  const MillRun& run = run_of(result, 0);
  std::size_t arcs = 0;
  for (std::size_t i = 0; i + 1 < run.size(); ++i) {
    if (run[i].bulge == 0) continue;
    ++arcs;
    const DrawnPoint off = to_centre(run[i].at, run[i + 1].at, run[i].bulge);
    const DrawnPoint centre{run[i].at.x + off.x, run[i].at.y + off.y};
    const double cx = centre.x < lengthy(20) ? 5 : 35;
    const double cy = centre.y < lengthy(15) ? 5 : 25;
    EXPECT_LT(distance_nm(centre, xy(cx, cy)), 3000) << i;
    EXPECT_NEAR(distance_nm(centre, run[i].at), 6.002e6, 1000);
  }
  EXPECT_EQ(arcs, 4U);
  EXPECT_EQ(run.size(), 10U);
  EXPECT_EQ(result.plan.lost_mm2, 0);
}

TEST(Outline, tabs_stay_at_their_height) {
  OutlineOptions options{.cutter = lengthy(2), .depth = lengthy(-1.5), .step = lengthy(0.5), .tabs = 4};
  options.tab_height = lengthy(0.6);
  const Outlined result = outlined(board_drawing(), options);
  EXPECT_EQ(result.plan.tabs.size(), 4U);
  double above = 0;
  const MillRun& run = result.plan.mill.tools.at(0).runs.back();
  for (std::size_t i = 0; i + 1 < run.size(); ++i) {
    if (run[i].z == lengthy(-0.9) && run[i + 1].z == lengthy(-0.9)) {
      above += way_nm(run[i].at, run[i + 1].at, run[i].bulge);
    }
    EXPECT_GE(run[i].z, lengthy(-1.5));
  }
  // Four tabs of 2 mm and the cutter's width, in the turns at -1 and -1.5 mm.
  EXPECT_NEAR(above / 1e6, 2 * 4 * 4, 0.001);
}

// Around a board of 40 x 30 mm with an opening of this diameter.
Outlined tabbed(double opening, const OutlineOptions& options) {
  Drawing drawing = board_drawing();
  drawing.holes = {{xy(20, 15), lengthy(opening), 0, 0}};
  return outlined(drawing, options);
}

TEST(Outline, a_slug_is_held_by_tabs_or_milled_away) {
  const OutlineOptions options{.cutter = lengthy(2), .tabs = 4};
  const Outlined held = tabbed(12, options);  // a slug of 8 mm
  EXPECT_EQ(held.plan.tabs.size(), 8U);
  EXPECT_EQ(held.plan.mill.tools.at(0).runs.size(), 2U);
  const Outlined milled = tabbed(6.5, options);  // one of 2.5 mm
  EXPECT_EQ(milled.plan.tabs.size(), 4U);
  EXPECT_EQ(milled.plan.lost_mm2, 0);
  // Nothing is left of it, and what is inside is milled first.
  std::vector<DrawnRing> ways = milled.plan.ways;
  const Region left = subtracted(swept({{xy(20, 15)}}, lengthy(3.2)), swept(ways, lengthy(1)));
  EXPECT_TRUE(left.empty());
  const auto& runs = milled.plan.mill.tools.at(0).runs;
  ASSERT_GE(runs.size(), 3U);
  EXPECT_LT(distance_nm(runs[0].front().at, xy(20, 15)), distance_nm(runs[1].front().at, xy(20, 15)));
  EXPECT_EQ(tabbed(6.5, {.cutter = lengthy(2)}).plan.mill.tools.at(0).runs.size(), 2U) << "without tabs";
}

TEST(Outline, as_many_tabs_as_fit_and_never_none) {
  OutlineOptions options{.cutter = lengthy(6.35), .tabs = 4, .tab_width = lengthy(5), .openings_only = true};
  const Outlined some = tabbed(25, options);
  EXPECT_EQ(some.plan.tabs.size(), 4U);
  EXPECT_TRUE(some.plan.mill.notes.empty());
  const Outlined fewer = tabbed(17, options);
  EXPECT_EQ(fewer.plan.tabs.size(), 2U);
  ASSERT_EQ(fewer.plan.mill.notes.size(), 1U);
  EXPECT_THAT(fewer.plan.mill.notes[0], testing::HasSubstr("4 tabs do not fit on a contour of 33.4"));
  options.tab_width = lengthy(40);
  EXPECT_EQ(tabbed(17, options).plan.tabs.size(), 1U);
}

TEST(Outline, tabs_lie_on_straight_pieces_and_apart) {
  // A slot with round ends: two straight pieces of 30 mm.
  Drawing drawing{.file = "edge.dxf", .layers = {"0"}, .holes = {}, .paths = {}, .notes = {}};
  DrawnPath path = open_line({{xy(0, 0)}, {xy(30, 0), 1}, {xy(30, 10)}, {xy(0, 10), 1}});
  path.is_closed = true;
  drawing.paths.push_back(path);
  const Outlined result = outlined(drawing, {.cutter = lengthy(2), .tabs = 6});
  ASSERT_EQ(result.plan.tabs.size(), 6U);
  for (const DrawnPoint& tab : result.plan.tabs) {
    EXPECT_GT(tab.x, lengthy(1.9));
    EXPECT_LT(tab.x, lengthy(28.1));
    for (const DrawnPoint& other : result.plan.tabs) {
      if (&other == &tab) continue;
      EXPECT_GT(distance_nm(tab, other), 4.1e6);
    }
  }
}

TEST(Outline, thin_tabs_are_told) {
  OutlineOptions options{.cutter = lengthy(2), .tabs = 2, .tab_width = lengthy(0.5)};
  const Outlined result = tabbed(5, options);
  ASSERT_EQ(result.plan.mill.notes.size(), 1U);
  EXPECT_THAT(result.plan.mill.notes[0], testing::HasSubstr("tabs of 0.5 x 0.6 mm break easily"));
}

TEST(Outline, tabs_by_place_lie_where_they_are_asked_for) {
  OutlineOptions options{.cutter = lengthy(2), .tab_places = {xy(10, -1), xy(20, 17)}};
  const Outlined result = outlined(board_drawing(), options);
  ASSERT_EQ(result.plan.tabs.size(), 2U);
  EXPECT_LT(distance_nm(result.plan.tabs[0], xy(20, 17)), 0.2e6);  // the opening is cut first
  EXPECT_LT(distance_nm(result.plan.tabs[1], xy(10, -1)), 0.5e6);
}

TEST(Outline, a_ramp_goes_down_no_steeper_than_asked) {
  OutlineOptions options{.cutter = lengthy(2), .depth = lengthy(-1), .step = lengthy(0.5), .ramp_degrees = 3};
  const Outlined result = outlined(board_drawing(), options);
  for (const MillRun& run : result.plan.mill.tools.at(0).runs) {
    EXPECT_EQ(run.front().z, Nanometres{});
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      const auto down = static_cast<double>(run[i].z.count - run[i + 1].z.count);
      EXPECT_LE(down, way_nm(run[i].at, run[i + 1].at, run[i].bulge) * std::tan(3 * M_PI / 180) + 2);
    }
    EXPECT_EQ(run.back().z, lengthy(-1));
  }
}

TEST(Outline, a_lead_in_comes_from_the_waste) {
  OutlineOptions options{.cutter = lengthy(2), .depth = lengthy(-1), .step = lengthy(0.5), .lead = lengthy(1.5)};
  const Outlined result = outlined(board_drawing(), options);
  EXPECT_EQ(result.plan.lost_mm2, 0);
  for (const MillRun& run : result.plan.mill.tools.at(0).runs) {
    EXPECT_NE(run.front().bulge, 0);
    EXPECT_FALSE(contains(grown(result.board, lengthy(1.0015)), run.front().at));
  }
}

TEST(Outline, dog_bones_reach_inner_corners) {
  Drawing drawing = board_drawing();
  drawing.holes.clear();
  DrawnPath slot = open_line({{xy(10, 10)}, {xy(20, 10)}, {xy(20, 20)}, {xy(10, 20)}});
  slot.is_closed = true;
  drawing.paths.push_back(slot);
  OutlineOptions options{.cutter = lengthy(2), .depth = lengthy(-1), .step = lengthy(1), .dog_bones = true};
  const Outlined result = outlined(drawing, options);
  for (const DrawnPoint corner : {xy(10, 10), xy(20, 10), xy(20, 20), xy(10, 20)}) {
    double nearest = 1e300;
    for (const MillPoint& point : run_of(result, 0)) nearest = std::min(nearest, distance_nm(point.at, corner));
    EXPECT_NEAR(nearest, 1e6, 5'000);
  }
}

TEST(Outline, an_opening_narrower_than_the_cutter_is_an_error) {
  const Outlined result = outlined(board_drawing(), {.cutter = lengthy(6.5)});
  ASSERT_EQ(result.findings.errors(), 1U);
  EXPECT_EQ(result.findings.all()[0].code, "outline.narrow-opening");
  EXPECT_THAT(result.findings.all()[0].message, testing::HasSubstr("X20 Y15"));
}

TEST(Outline, no_edge_is_an_error) {
  Diagnostics findings;
  plan_outline({}, {}, findings);
  ASSERT_EQ(findings.errors(), 1U);
  EXPECT_EQ(findings.all()[0].code, "outline.no-edge");
}

}  // namespace
}  // namespace passo
