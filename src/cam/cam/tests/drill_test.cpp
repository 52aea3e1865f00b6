#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/cam/drill_plan.hpp"
#include "passo/cam/drill_program.hpp"

namespace passo {
namespace {

Nanometres mm(double value) {
  return to_nanometres(Mm(value));
}
DrawnHole hole_at(double x, double y, double diameter) {
  return {{mm(x), mm(y)}, mm(diameter), 0, 7};
}
Drawing board_of(std::vector<DrawnHole> holes, std::vector<DrawnPath> paths = {}) {
  return {.file = "board.drl", .layers = {"T1"}, .holes = std::move(holes), .paths = std::move(paths), .notes = {}};
}
DrawnPath slot_of(double width) {
  return {.points = {{{mm(10), mm(10)}}, {{mm(14), mm(10)}}},
          .is_closed = false,
          .width = mm(width),
          .layer = 0,
          .line = 9};
}
struct Planned {
  DrillPlan plan;
  Diagnostics found;
};
Planned plan_of(const Drawing& drawing, const DrillOptions& options) {
  Planned planned;
  planned.plan = plan_drilling({drawing}, options, planned.found);
  return planned;
}

TEST(DrillPlan, without_a_rack_each_diameter_has_its_drill) {
  const Planned planned = plan_of(board_of({hole_at(5, 5, 1), hole_at(1, 1, 0.8), hole_at(9, 1, 0.8)}), {});
  ASSERT_EQ(planned.plan.tools.size(), 2U);
  EXPECT_EQ(planned.plan.tools[0].diameter, mm(0.8));
  EXPECT_EQ(planned.plan.tools[0].holes, 2U);
  EXPECT_EQ(planned.plan.tools[1].holes, 1U);
}

TEST(DrillPlan, a_rack_serves_within_its_tolerance_and_no_hole_is_lost) {
  const Drawing board = board_of({hole_at(5, 5, 1.02), hole_at(1, 1, 0.8), hole_at(9, 1, 1.5)});
  const Planned planned = plan_of(board, {.rack = {mm(0.8), mm(1)}, .tolerance = mm(0.05)});
  ASSERT_EQ(planned.found.errors(), 1U);
  EXPECT_EQ(planned.found.all()[0].code, "drill.no-tool");
  EXPECT_EQ(planned.found.all()[0].place.line, 7U);
  EXPECT_THAT(planned.plan.notes, testing::ElementsAre("1 hole of 1.02 mm is made with the drill of 1 mm"));
  const Planned wider = plan_of(board, {.rack = {mm(0.8), mm(1)}, .tolerance = mm(0.5)});
  EXPECT_FALSE(wider.found.any_error());
}

TEST(DrillPlan, one_drill_makes_all_and_of_holes_at_one_place_one) {
  const Planned planned =
      plan_of(board_of({hole_at(5, 5, 1), hole_at(5, 5, 2), hole_at(1, 1, 0)}), {.one_drill = mm(0.75)});
  ASSERT_EQ(planned.plan.tools.size(), 1U);
  EXPECT_EQ(planned.plan.tools[0].diameter, mm(0.75));
  EXPECT_EQ(planned.plan.tools[0].holes, 2U);
  EXPECT_THAT(planned.plan.notes, testing::ElementsAre(testing::HasSubstr("a hole lies on others")));
  EXPECT_EQ(plan_of(board_of({hole_at(1, 1, 0)}), {}).found.all().at(0).code, "drill.no-diameter");
  EXPECT_EQ(plan_of(board_of({}), {}).found.all().at(0).code, "drill.no-holes");
}

TEST(DrillPlan, wide_holes_and_slots_are_milled) {
  const Planned planned = plan_of(board_of({hole_at(5, 5, 3.2), hole_at(1, 1, 0.8)}, {slot_of(2)}), {.mill = mm(1)});
  ASSERT_EQ(planned.plan.tools.size(), 2U);
  const DrillTool& mill = planned.plan.tools[1];
  EXPECT_TRUE(mill.is_mill);
  EXPECT_EQ(mill.holes, 1U);
  EXPECT_EQ(mill.slots, 1U);
  for (const DrillTarget& target : mill.targets) {
    if (target.kind == DrillTarget::Kind::circle) {
      EXPECT_EQ(target.radius, mm(1.1));
    } else {
      ASSERT_EQ(target.points.size(), 4U);
      EXPECT_EQ(target.points[0].at, (DrawnPoint{mm(10), mm(9.5)}));
      EXPECT_EQ(target.points[2].at, (DrawnPoint{mm(14), mm(10.5)}));
    }
  }
}

TEST(DrillPlan, without_a_cutter_slots_are_rows_of_holes) {
  const Planned planned = plan_of(board_of({}, {slot_of(1)}), {});
  ASSERT_EQ(planned.plan.tools.size(), 1U);
  EXPECT_EQ(planned.plan.tools[0].targets.size(), 9U) << "4 mm, half a millimetre apart, both ends";
  DrawnPath bow = slot_of(1);
  bow.points[0].bulge = 1;  // a half circle about (12, 10), below
  const Planned bent = plan_of(board_of({}, {bow}), {});
  for (const DrillTarget& target : bent.plan.tools.at(0).targets) {
    EXPECT_NEAR(distance_nm(target.points[0].at, {mm(12), mm(10)}), 2e6, 2);
    EXPECT_LE(target.points[0].at.y.count, mm(10).count + 2);
  }
}

TEST(DrillProgram, one_tool_has_no_change_and_begins_and_ends_high) {
  const Planned planned = plan_of(board_of({hole_at(10, 0, 0.8), hole_at(20, 0, 0.8)}), {});
  EXPECT_EQ(
      write_drill_program(
          planned.plan,
          {.name = "b(1).ngc", .files = {"board.drl"}, .clearance = mm(2), .depth = mm(-3), .spindle = {}, .park = {}}),
      "(b_1_.ngc: holes, by passo cam drill)\n(from board.drl)\n(tool 1: drill 0.8 mm, 2 holes)\n"
      "(X0 Y0 is the drawing's zero, Z0 the face of the board)\nG17 G21 G40 G80 G90 G94\n\n"
      "(tool 1: drill 0.8 mm, 2 holes)\nG0 Z20\nG0 X10 Y0\nG0 Z2\nF100\nG98 G81 X10 Y0 Z-3 R0.5\nX20 Y0\nG80\n"
      "G0 Z20\nG0 X0 Y0\nM2\n");
}

TEST(DrillProgram, the_drill_stays_low_between_near_holes_and_rises_for_the_way_to_a_far_one) {
  const Planned planned = plan_of(board_of({hole_at(10, 0, 0.8), hole_at(12, 0, 0.8), hole_at(14, 0, 0.8),
                                            hole_at(30, 0, 0.8), hole_at(32, 0, 0.8)}),
                                  {});
  DrillProgramOptions options{.name = "b", .clearance = mm(3), .feed_height = mm(0.4), .depth = mm(-2), .park = {}};
  EXPECT_THAT(write_drill_program(planned.plan, options),
              testing::HasSubstr("G99 G81 X10 Y0 Z-2 R0.4\nX12 Y0\nG98 X14 Y0\nG99 X30 Y0\nG98 X32 Y0\nG80\n"));
  options.canned = false;
  EXPECT_THAT(write_drill_program(planned.plan, options),
              testing::HasSubstr("G0 X10 Y0\nG0 Z0.4\nG1 Z-2\nG0 Z0.4\nG0 X12 Y0\nG1 Z-2\nG0 Z0.4\nG0 X14 Y0\nG1 Z-2\n"
                                 "G0 Z3\nG0 X30 Y0\nG0 Z0.4\nG1 Z-2\nG0 Z0.4\nG0 X32 Y0\nG1 Z-2\nG0 Z3\n"));
  options.clearance = mm(0.2);  // below the feed height
  EXPECT_THAT(write_drill_program(planned.plan, options),
              testing::HasSubstr("G0 X10 Y0\nG1 Z-2\nG0 Z0.2\nG0 X12 Y0\n"));
}

TEST(DrillProgram, centimetres_and_inches_scale_every_length) {
  const Planned planned = plan_of(board_of({hole_at(25.4, 50.8, 0.8)}), {});
  DrillProgramOptions options{.name = "b", .clearance = mm(2), .depth = mm(-3), .peck = mm(1), .feed = mm(254)};
  options.units = ProgramUnits::cm;
  const std::string cm = write_drill_program(planned.plan, options);
  EXPECT_THAT(cm, testing::HasSubstr("G98 G83 X2.54 Y5.08 Z-0.3 R0.05 Q0.1\n"));
  EXPECT_THAT(cm, testing::HasSubstr("F25.4\n"));
  EXPECT_THAT(cm, testing::HasSubstr("centimetres"));
  EXPECT_THAT(cm, testing::Not(testing::HasSubstr("G21")));
  options.units = ProgramUnits::inch;
  const std::string inch = write_drill_program(planned.plan, options);
  EXPECT_THAT(inch, testing::HasSubstr("G98 G83 X1 Y2 Z-0.11811 R0.01969 Q0.03937\n"));
  EXPECT_THAT(inch, testing::HasSubstr("G20"));
}

TEST(DrillProgram, plain_moves_peck_and_circles_go_down_in_turns) {
  const Planned planned = plan_of(board_of({hole_at(5, 5, 3), hole_at(1, 1, 0.8)}), {.mill = mm(1)});
  const std::string text = write_drill_program(
      planned.plan,
      {.name = "b", .files = {}, .depth = mm(-1), .peck = mm(0.4), .spindle = 9000, .park = {}, .canned = false});
  EXPECT_THAT(
      text, testing::HasSubstr("G0 X1 Y1\nG0 Z0.5\nG1 Z-0.4\nG0 Z2\nG0 Z-0.15\nG1 Z-0.8\nG0 Z2\nG0 Z-0.55\nG1 Z-1\n"));
  EXPECT_THAT(text, testing::HasSubstr("(MSG, tool 2: mill 1 mm)\nT2 M6\n"));
  EXPECT_THAT(text, testing::HasSubstr("G3 X6 Y5 Z-0.5 I-1 J0\nG3 X6 Y5 Z-1 I-1 J0\nG3 X6 Y5 I-1 J0\n"));
  EXPECT_THAT(text, testing::HasSubstr("M3 S9000\n"));
}

TEST(DrillProgram, a_wide_bore_is_milled_from_its_middle_outwards) {
  const Planned planned = plan_of(board_of({hole_at(0, 0, 7)}), {.mill = mm(2)});
  const std::string text = write_drill_program(planned.plan, {.files = {}, .depth = mm(-0.5), .canned = false});
  // Radii of the cutter centre from 0.9 to 2.5 mm: 0.8 diameters apart.
  const std::size_t inner = text.find("G3 X0.9 Y0 I-0.9 J0\n");
  const std::size_t outer = text.find("G3 X2.5 Y0 I-2.5 J0\n");
  ASSERT_NE(outer, std::string::npos) << text;
  EXPECT_LT(inner, outer);
  // A hole of two diameters has no core.
  const Planned narrow = plan_of(board_of({hole_at(0, 0, 4)}), {.mill = mm(2)});
  const std::string once = write_drill_program(narrow.plan, {.files = {}, .depth = mm(-0.5), .canned = false});
  EXPECT_EQ(once.find("G3 X0.9"), std::string::npos);
  EXPECT_NE(once.find("G3 X1 Y0 Z-0.5 I-1 J0\n"), std::string::npos);
}

}  // namespace
}  // namespace passo
