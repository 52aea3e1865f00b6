// Cycles: what the golden programs (drilling, threading, lathe_cycles) do not show.
#include <cmath>

#include "interpreted.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

TEST(DrillingCycles, any_number_of_holes_and_pecks_fits) {
  const Interpreted holes = interpret_text("G21 F100 G91\nG81 X1 Z-1 R1 L5000\nM2\n");
  EXPECT_FALSE(holes.diagnostics.any_error()) << holes.rendered();
  EXPECT_EQ(holes.all<operation::StraightFeed>().size(), 5000U);
  EXPECT_EQ(holes.last<operation::StraightTraverse>().end[Axis::x], 5000);
  const Interpreted pecks = interpret_text("G21 F100\nG83 X1 Z-10 R0 Q.01\nM2\n");
  EXPECT_EQ(pecks.all<operation::StraightFeed>().size(), 1000U);
  EXPECT_NEAR(pecks.last<operation::StraightFeed>().end[Axis::z], -10, 1e-9);
}

// As in LinuxCNC 2.10. D is in the program's units, and counts in its own block alone.
TEST(DrillingCycles, the_word_d_says_how_far_a_peck_goes_back) {
  const auto heights = [](const std::string& program) {
    std::string text;
    for (const auto& rapid : interpret_text(program).all<operation::StraightTraverse>()) {
      text += fmt::format(" {:g}", rapid.end[Axis::z]);
    }
    return text;
  };
  EXPECT_EQ(heights("G21 F100 G0 Z5\nG99 G73 X1 Z-6 R1 Q3 D0.5\nX2\nX3 D1\nM2\n"),
            " 5 5 1 -1.5 -4.5 1 1 -1.746 -4.746 1 1 -1 -4 1");
  EXPECT_EQ(heights("G20 F100 G0 Z1\nG99 G73 X1 Z-1 R0 Q0.5 D0.1\nM2\n"), " 25.4 25.4 0 -10.16 0");
  EXPECT_EQ(heights("G21 F100 G0 Z5\nG99 G83 X1 Z-6 R1 Q3 D0.5\nM2\n"), " 5 5 1 1 -1.5 1 -4.5 1");
  for (const char* const words : {"G73 X1 Z-6 R1 Q3 D-1", "G81 X1 Z-6 R1 D1", "G1 X1 D1"}) {
    const Interpreted result = interpret_text(std::string("G21 F100\n") + words + "\nM2\n");
    EXPECT_EQ(result.diagnostics.errors(), 1U) << words << result.rendered();
  }
}

TEST(DrillingCycles, what_stops_the_program_comes_behind_the_last_hole) {
  const std::string calls = interpret_text("G21 F100 G91 G81 X1 Z-1 R1 L100 M2\n").calls();
  EXPECT_GT(calls.find("PROGRAM_END"), calls.rfind("STRAIGHT_FEED(100.0000"));
}

// LinuxCNC's STRAIGHT_FEED of G74 and G84 has the axes in another order outside the plane XY: the tap would leave its
// hole sideways.
TEST(DrillingCycles, a_tap_moves_along_its_axis_in_every_plane) {
  struct InPlane {
    const char* words;
    Axis axis;
  };
  for (const auto& [words, axis] : {InPlane{"G17\nG84 X3 Y5 Z-7 R2", Axis::z},
                                    {"G18\nG84 X3 Z5 Y-7 R2", Axis::y},
                                    {"G19\nG84 Y3 Z5 X-7 R2", Axis::x}}) {
    const Interpreted result = interpret_text(std::string("G21 F100 M3 S100 ") + words + "\nM2\n");
    const auto feeds = result.all<operation::StraightFeed>();
    ASSERT_EQ(feeds.size(), 2U) << result.rendered();
    Point expected = result.last<operation::StraightTraverse>().end;  // above the hole
    EXPECT_EQ(expected[axis], 2);
    EXPECT_EQ(feeds[1].end, expected);
    expected[axis] = -7;
    EXPECT_EQ(feeds[0].end, expected);
  }
}

std::string calls_from(const std::string& program, const char* first) {
  const Interpreted result = interpret_text(program);
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  const std::string calls = result.calls();
  const std::size_t begin = calls.find(first);
  const std::size_t end = calls.find("SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS");
  return begin == std::string::npos || end == std::string::npos ? calls : calls.substr(begin, end - begin);
}

// As rs274 does it, with I, J and K along X, Y and Z in every plane.
TEST(DrillingCycles, a_back_bore_goes_aside_through_the_hole_and_cuts_upwards) {
  EXPECT_EQ(calls_from("G21 F600 M4 S100 G18\nG0 Y1\nG91\nG87 X1 Z1 Y-1 R0.5 I0.1 J-0.2 K0.3\nM2\n",
                       "STRAIGHT_TRAVERSE(1.0000, 1.5000, 1.0000"),
            "STRAIGHT_TRAVERSE(1.0000, 1.5000, 1.0000, 0.0000, 0.0000, 0.0000)\n"
            "STRAIGHT_TRAVERSE(1.1000, 1.5000, 1.3000, 0.0000, 0.0000, 0.0000)\n"
            "STOP_SPINDLE_TURNING(0)\n"
            "ORIENT_SPINDLE(0, 0.0000, 3)\n"
            "STRAIGHT_TRAVERSE(1.1000, 0.5000, 1.3000, 0.0000, 0.0000, 0.0000)\n"
            "STRAIGHT_TRAVERSE(1.0000, 0.5000, 1.0000, 0.0000, 0.0000, 0.0000)\n"
            "START_SPINDLE_COUNTERCLOCKWISE(0)\n"
            "STRAIGHT_FEED(1.0000, 0.3000, 1.0000, 0.0000, 0.0000, 0.0000)\n"
            "STRAIGHT_FEED(1.0000, 0.5000, 1.0000, 0.0000, 0.0000, 0.0000)\n"
            "STOP_SPINDLE_TURNING(0)\n"
            "ORIENT_SPINDLE(0, 0.0000, 3)\n"
            "STRAIGHT_TRAVERSE(1.1000, 0.5000, 1.3000, 0.0000, 0.0000, 0.0000)\n"
            "STRAIGHT_TRAVERSE(1.1000, 1.5000, 1.3000, 0.0000, 0.0000, 0.0000)\n"
            "STRAIGHT_TRAVERSE(1.0000, 1.5000, 1.0000, 0.0000, 0.0000, 0.0000)\n"
            "START_SPINDLE_COUNTERCLOCKWISE(0)\n");
}

// On the machine nobody has a hand on the tool: it must not go on from the bottom of the hole.
TEST(DrillingCycles, a_retract_by_hand_is_a_rapid_on_the_machine) {
  const std::string program = "G21 F600 M3 S100 G0 Z1\nG88 X1 Z-1 R0.5 P1\nM2\n";
  EXPECT_EQ(calls_from(program, "STRAIGHT_FEED"),
            "STRAIGHT_FEED(1.0000, 0.0000, -1.0000, 0.0000, 0.0000, 0.0000)\nDWELL(1.0000)\n"
            "STOP_SPINDLE_TURNING(0)\nPROGRAM_STOP()\nSTART_SPINDLE_CLOCKWISE(0)\n");
  InterpreterOptions options;
  options.on_machine = true;
  EXPECT_THAT(interpret_text(program, options).calls(),
              HasSubstr("PROGRAM_STOP()\nSTRAIGHT_TRAVERSE(1.0000, 0.0000, 0.5000, 0.0000, 0.0000, 0.0000)\n"
                        "START_SPINDLE_CLOCKWISE(0)\n"));
}

TEST(DrillingCycles, in_the_planes_of_UVW_drill_along_the_axis_through_them) {
  struct InPlane {
    const char* words;
    Axis axis;
  };
  for (const auto& [words, axis] : {InPlane{"G17.1\nG81 U3 V5 W-7 R2", Axis::w},
                                    {"G18.1\nG81 U3 W5 V-7 R2", Axis::v},
                                    {"G19.1\nG81 V3 W5 U-7 R2", Axis::u}}) {
    const Interpreted result = interpret_text(std::string("G21 F100 ") + words + "\nM2\n");
    EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
    EXPECT_THAT(result.calls(), HasSubstr("SELECT_PLANE(CANON_PLANE_UNKNOWN)"));
    Point expected = result.last<operation::StraightTraverse>().end;
    EXPECT_EQ(expected[axis], 2);
    expected[axis] = -7;
    EXPECT_EQ(result.last<operation::StraightFeed>().end, expected);
  }
}

TEST(DrillingCycles, tapping_leaves_overrides_off_that_were_off) {
  const Interpreted result = interpret_text("G21 F100 M3 S100 M49\nG84 X1 Z-1 R1\nX2\nM0\n");
  for (const auto& set : result.all<operation::SetFeedOverride>()) EXPECT_FALSE(set.on);
  for (const auto& set : result.all<operation::SetSpeedOverride>()) EXPECT_FALSE(set.on);
}

TEST(DrillingCycles, words_stay_in_millimetres_when_the_units_change) {
  const Interpreted result = interpret_text("G20 F10\nG81 X1 Z-1 R.5\nG21\nX5\nM2\n");
  EXPECT_DOUBLE_EQ(result.last<operation::StraightFeed>().end[Axis::z], -25.4);
  EXPECT_DOUBLE_EQ(result.last<operation::StraightTraverse>().end[Axis::z], 12.7);
}

TEST(DrillingCycles, a_first_block_that_is_wrong_is_told_once_and_nothing_is_drilled) {
  const Interpreted result = interpret_text("G21 F100\nG81 X1 Z-1\nX2\nX3\nG81 X4 Z-1 R1\nM2\n");
  EXPECT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  EXPECT_EQ(result.all<operation::StraightFeed>().size(), 1U);
}

TEST(DrillingCycles, the_path_mode_comes_back) {
  const Interpreted result = interpret_text("G21 F100 G64 P.1 Q.2\nG81 X1 Z-1 R1\nM2\n");
  EXPECT_EQ(result.last<operation::SetPathMode>().mode, PathMode::continuous);
  EXPECT_EQ(result.last<operation::SetPathMode>().tolerance, Mm(0.1));
  EXPECT_EQ(result.last<operation::SetMergeTolerance>().tolerance, Mm(0.2));
}

TEST(ThreadingCycle, the_last_pass_is_as_deep_as_k_and_springs_repeat_it) {
  const Interpreted result = interpret_text("G21 G18 M3 S100\nG0 X20 Z5\nG76 P1.5 Z-10 I-2 J.3 K1 R1.5 H2\nM2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  const auto cuts = result.all<operation::StraightFeed>();
  ASSERT_EQ(cuts.size(), 7U + 2);  // 0.3 * 6^(2/3) is the last below 1
  EXPECT_NEAR(cuts[0].end[Axis::x], 20 - 2 - 0.3, 1e-12);
  EXPECT_NEAR(cuts[5].end[Axis::x], 20 - 2 - 0.3 * std::pow(6, 2.0 / 3), 1e-12);
  for (std::size_t i = 6; i < cuts.size(); ++i) EXPECT_NEAR(cuts[i].end[Axis::x], 17, 1e-12);
  EXPECT_EQ(result.all<operation::StartSpeedFeedSync>().size(), cuts.size());
  EXPECT_EQ(result.all<operation::StopSpeedFeedSync>().size(), cuts.size());
}

TEST(ThreadingCycle, overrides_that_are_off_stay_off) {
  const Interpreted result = interpret_text("G21 G18 M3 S100 M49\nG0 X20 Z5\nG76 P1 Z-9 I-2 J.3 K1\nM0\n");
  for (const auto& set : result.all<operation::SetFeedOverride>()) EXPECT_FALSE(set.on);
}

const std::string shaft =
    "G21 G18 F100\no7 sub\nG0 X5 Z1\nG1 Z-4\nX8 Z-7\nG3 X10 Z-9 K-2\nG1 Z-12\nX14\no7 endsub\nG0 X30 Z5\n";

// Roughing and finishing never cut below the contour, which is known here in closed form.
double shaft_radius(double z) {
  if (z >= -4) return 5;
  if (z >= -7) return 5 + (-4 - z);
  if (z >= -9) return 8 + std::sqrt(std::max(0.0, 4 - (z + 9) * (z + 9)));
  return z >= -12 ? 10 : 14;
}

TEST(LatheCycles, roughing_stays_outside_the_contour_and_takes_what_is_between) {
  const Interpreted result = interpret_text(shaft + "G71 Q7 X15 Z2 I.5 R.2\nM2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  const auto feeds = result.all<operation::StraightFeed>();
  EXPECT_GT(feeds.size(), 20U);
  for (const auto& feed : feeds) {
    EXPECT_GE(feed.end[Axis::x], shaft_radius(feed.end[Axis::z]) - 1e-6) << feed.end[Axis::z];
  }
  // Each step down is half a millimetre at most.
  double last = 15;
  for (const auto& feed : feeds) {
    EXPECT_GE(feed.end[Axis::x], last - 0.5 - 1e-9);
    last = std::min(last, feed.end[Axis::x]);
  }
  EXPECT_NEAR(last, 5, 1e-9);
}

TEST(LatheCycles, finishing_comes_nearer_pass_by_pass) {
  const Interpreted result = interpret_text(shaft + "G70 Q7 X15 Z2 D.6 E0 P3\nM2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  std::vector<double> radii;
  for (const auto& feed : result.all<operation::StraightFeed>()) {
    if (radii.empty() || feed.end[Axis::x] < radii.back() - 2) radii.push_back(feed.end[Axis::x]);
  }
  EXPECT_EQ(result.all<operation::ArcFeed>().size(), 3U);
  EXPECT_NEAR(result.last<operation::ArcFeed>().end[Axis::x], 10, 1e-9);
  const auto arcs = result.all<operation::ArcFeed>();
  EXPECT_NEAR(arcs[0].end[Axis::x], 10.4, 1e-9);
  EXPECT_NEAR(arcs[1].end[Axis::x], 10.2, 1e-9);
}

TEST(LatheCycles, a_contour_may_be_computed_and_its_sub_may_stand_behind) {
  const Interpreted result = interpret_text(
      "G21 G18 F100\nG70 Q9 X20 Z2\nM2\no9 sub\nG0 X5\n#1=0\no1 while [#1 LT 3]\n#1=[#1+1]\nG1 Z[0-#1*#1]\n"
      "X[5+#1]\no1 endwhile\no9 endsub\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_EQ(result.last<operation::StraightFeed>().end[Axis::x], 8);
  EXPECT_EQ(result.last<operation::StraightFeed>().end[Axis::z], -9);
}

TEST(LatheCycles, the_program_goes_on_behind_the_cycle) {
  const std::string calls = interpret_text(shaft + "G71 Q7 X15 Z2\n(msg,next)\nX30\nM2\n").calls();
  EXPECT_THAT(calls, HasSubstr("MESSAGE(\"next\")\nSTRAIGHT_FEED(30.0000"));
}

TEST(LatheCycles, what_has_no_effect_in_a_contour_is_told) {
  const Interpreted result =
      interpret_text("G21 G18 F100\no7 sub\nG0 X5\nG1 Z-4 F50\nX9\no7 endsub\nG71 Q7 X12 Z2\nM2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  ASSERT_EQ(result.diagnostics.all().size(), 1U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.unused-in-contour");
  EXPECT_EQ(result.diagnostics.all().front().place.line, 4U);
}

TEST(LatheCycles, corners_are_rounded_and_cut_off) {
  const Interpreted result =
      interpret_text("G21 G18 F100\no7 sub\nG0 X5\nG1 Z-4 A.5\nX9 C.5\nZ-9\nX12\no7 endsub\nG70 Q7 X15 Z2\nM2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  const auto arcs = result.all<operation::ArcFeed>();
  ASSERT_EQ(arcs.size(), 1U) << result.canon;
  EXPECT_NEAR(arcs[0].end[Axis::x], 5.5, 1e-9);
  EXPECT_NEAR(arcs[0].end[Axis::z], -4, 1e-9);
  EXPECT_THAT(result.calls(), HasSubstr("STRAIGHT_FEED(8.5000, 0.0000, -4.0000, 0.0000, 0.0000, 0.0000)\n"
                                        "STRAIGHT_FEED(9.0000, 0.0000, -4.5000"));
}

// Contours that LinuxCNC 2.9 goes round for ever.
TEST(LatheCycles, every_contour_comes_to_an_end) {
  const Interpreted pocket = interpret_text(
      "G20 G18 F100\no7 sub\nG0 X3\nG1 Z1\nX7\nG3 X10 Z4 I3\nG1 Z6\nG2 X11 Z7 K1\no7 endsub\n"
      "G72.2 Q7 X12 Z-2 D0.3 R0.3\nM2\n");
  EXPECT_LT(pocket.operations.size(), 100U);
  const Interpreted sloped = interpret_text(
      "G21 G18 F100\no7 sub\nG1 X10 Z0\nX10 Z-14\nX3\nX7 Z-22\no7 endsub\nG71.2 Q7 X15 Z0 D.04 I.5 R1\nM2\n");
  EXPECT_FALSE(sloped.diagnostics.any_error()) << sloped.rendered();
  EXPECT_LT(sloped.operations.size(), 200U);
}

// As LinuxCNC 2.10 does it; 2.9 cuts along the contour once, through all of the stock.
TEST(LatheCycles, a_face_as_deep_as_the_contour_begins_is_roughed_too) {
  const Interpreted result =
      interpret_text("G21 G18 F100\no1 sub\nG1 X5 Z-4\nX10 Z-4\no1 endsub\nG72 Q1 X5 Z0 I1 R0.1\nM2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  std::vector<double> cuts;
  for (const auto& feed : result.all<operation::StraightFeed>()) {
    if (feed.end[Axis::x] == 10) cuts.push_back(feed.end[Axis::z]);
  }
  EXPECT_THAT(cuts, testing::ElementsAre(0, -1, -2, -3, -4, testing::_)) << result.calls();
}

}  // namespace
}  // namespace passo
