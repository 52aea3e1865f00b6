// Cutter compensation: how far the tool's centre is from the contour, and what is held back meanwhile.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "../block_executor.hpp"
#include "interpreted.hpp"
#include "kit/seed.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/gcode/block_parser.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

struct At {
  double x = 0;
  double y = 0;
};
double distance(At a, At b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}
At of(const Point& point) {
  return {point[Axis::x], point[Axis::y]};
}

// The distance of a point from a line from a to b.
double distance(At p, At a, At b) {
  const double length = distance(a, b);
  const double along = ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / (length * length);
  const double k = std::clamp(along, 0.0, 1.0);
  return distance(p, {a.x + k * (b.x - a.x), a.y + k * (b.y - a.y)});
}

// Points on the way of all moves from the first feed on, close to each other.
std::vector<At> walk(const Interpreted& result) {
  constexpr int steps = 40;
  std::vector<At> points;
  At here;
  for (const Operation& operation : result.operations) {
    if (const auto* const rapid = std::get_if<operation::StraightTraverse>(&operation.what)) here = of(rapid->end);
    if (const auto* const line = std::get_if<operation::StraightFeed>(&operation.what)) {
      const At end = of(line->end);
      for (int i = 0; i <= steps; ++i) {
        const double k = static_cast<double>(i) / steps;
        points.push_back({here.x + k * (end.x - here.x), here.y + k * (end.y - here.y)});
      }
      here = end;
    }
    if (const auto* const arc = std::get_if<operation::ArcFeed>(&operation.what)) {
      const At end = of(arc->end);
      const At center{arc->first_center.value(), arc->second_center.value()};
      const double from = std::atan2(here.y - center.y, here.x - center.x);
      double sweep = std::atan2(end.y - center.y, end.x - center.x) - from;
      const double full = 2 * std::numbers::pi;
      if (arc->turns > 0 && sweep <= 0) sweep += full;
      if (arc->turns < 0 && sweep >= 0) sweep -= full;
      for (int i = 0; i <= steps; ++i) {
        const double angle = from + sweep * i / steps;
        const double radius = distance(here, center);
        points.push_back({center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
      }
      here = end;
    }
  }
  return points;
}

// A star of straight lines about the origin, counterclockwise: inside and outside corners. From the middle of its first
// line to there.
std::vector<At> star(std::mt19937_64& random) {
  std::uniform_real_distribution<double> radius(30, 60);
  const int corners = std::uniform_int_distribution<int>(3, 12)(random);
  std::vector<At> contour;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double r = radius(random);
    contour.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  const At middle{(contour[0].x + contour[1].x) / 2, (contour[0].y + contour[1].y) / 2};
  contour.push_back(contour.front());
  contour.push_back(middle);
  contour.front() = middle;
  return contour;
}

TEST(CutterCompensation, the_tool_stays_its_radius_from_the_contour_and_touches_it) {
  std::mt19937_64 random(test::seed());
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(test::seed()));
  int walked = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<At> contour = star(random);
    const double radius = std::uniform_real_distribution<double>(0.2, 3)(random);
    const bool outside = i % 2 == 0;
    // In along the first line, from where it begins.
    const At start = contour[contour.size() - 2];
    std::string program =
        fmt::format("G21 F100\nG0 X{:.6f} Y{:.6f}\nG{}.1 D{:.6f}\n", start.x, start.y, outside ? 42 : 41, 2 * radius);
    for (const At corner : contour) program += fmt::format("G1 X{:.6f} Y{:.6f}\n", corner.x, corner.y);
    const Interpreted result = interpret_text(program + "G40\nM2\n");
    if (result.diagnostics.any_error()) continue;  // a sharp corner between short lines
    ++walked;
    double nearest_of_all = 1e9;
    bool entered = false;
    for (const At point : walk(result)) {
      double nearest = 1e9;
      for (std::size_t k = 0; k + 1 < contour.size(); ++k) {
        nearest = std::min(nearest, distance(point, contour[k], contour[k + 1]));
      }
      entered = entered || std::abs(nearest - radius) < 0.002 * radius;
      if (!entered) continue;
      ASSERT_GT(nearest, radius * 0.998) << program << result.canon;
      nearest_of_all = std::min(nearest_of_all, nearest);
    }
    EXPECT_NEAR(nearest_of_all, radius, 0.002 * radius) << program;
  }
  EXPECT_GT(walked, 100);
}

TEST(CutterCompensation, what_stands_between_two_moves_keeps_its_place) {
  const Interpreted result =
      interpret_text("G21 F100\nG41.1 D2\nG1 X10\n(first)\nM8\nF50\nZ3\n(second)\nY10\nG40\nG1 X0\nM2\n");
  EXPECT_THAT(result.calls(), HasSubstr("STRAIGHT_FEED(9.0000, 1.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
                                        "COMMENT(\"first\")\nFLOOD_ON()\nSET_FEED_RATE(50.0000)\n"
                                        "STRAIGHT_FEED(9.0000, 1.0000, 3.0000, 0.0000, 0.0000, 0.0000)\n"
                                        "COMMENT(\"second\")\n"
                                        "STRAIGHT_FEED(9.0000, 10.0000, 3.0000, 0.0000, 0.0000, 0.0000)\n"));
}

TEST(CutterCompensation, messages_units_and_tool_numbers_do_not_wait) {
  const Interpreted result =
      interpret_text("G21 F100\nG41.1 D2.54\nG1 X12.7\n(kept)\n(msg,now)\nT4\nG20\nG21\nY10\nG40\nM2\n");
  EXPECT_THAT(result.calls(),
              HasSubstr("MESSAGE(\"now\")\nSELECT_TOOL(4)\nUSE_LENGTH_UNITS(CANON_UNITS_INCHES)\n"
                        "USE_LENGTH_UNITS(CANON_UNITS_MM)\n"
                        "STRAIGHT_FEED(11.4300, 1.2700, 0.0000, 0.0000, 0.0000, 0.0000)\nCOMMENT(\"kept\")\n"));
}

TEST(CutterCompensation, a_move_that_was_held_comes_from_its_own_line) {
  const std::string program = "G21 F100\nG41.1 D2\nN30 G1 X10\nN40 Y-10\nN50 G40\nM2\n";
  Diagnostics diagnostics;
  Interpreter interpreter(ProgramReader::from_text("test.ngc", program), {}, diagnostics);
  std::vector<std::string> lines;
  Operation operation;
  while (interpreter.next(operation)) {
    const bool moves = std::holds_alternative<operation::StraightFeed>(operation.what) ||
                       std::holds_alternative<operation::ArcFeed>(operation.what);
    if (moves) {
      lines.push_back(fmt::format("{}:{} {} {}", operation.file, operation.source.line, operation.source.line_number,
                                  operation.text));
    }
  }
  EXPECT_THAT(lines,
              testing::ElementsAre("test.ngc:3 30 N30 G1 X10", "test.ngc:4 40 N40 Y-10", "test.ngc:4 40 N40 Y-10"));
}

TEST(CutterCompensation, a_stop_and_the_end_of_the_file_let_go_of_the_last_move) {
  EXPECT_THAT(interpret_text("G21 F100\nG41.1 D2\nG1 X10\nM0\nX20\nG40\nM2\n").calls(),
              HasSubstr("STRAIGHT_FEED(10.0000, 1.0000, 0.0000, 0.0000, 0.0000, 0.0000)\nPROGRAM_STOP()\n"));
  EXPECT_THAT(interpret_text("G21 F100\nG41.1 D2\nG1 X10\n").calls(), HasSubstr("STRAIGHT_FEED(10.0000, 1.0000"));
  EXPECT_THAT(interpret_text("G21 F100\nG41.1 D2\nG1 X10\nM2\n").calls(), HasSubstr("STRAIGHT_FEED(10.0000, 1.0000"));
}

TEST(CutterCompensation, a_stop_in_an_inside_corner_is_warned_of) {
  const Interpreted result = interpret_text("G21 F100\nG41.1 D2\nG1 X10\nM0\nY10\nG40\nM2\n");
  ASSERT_EQ(result.diagnostics.all().size(), 1U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.cutter-stop");
}

TEST(CutterCompensation, a_tool_without_a_diameter_is_warned_of_and_compensates_nothing) {
  const Interpreted result = interpret_text("G21 F100\nG41\nG1 X10\nG40\nM2\n");
  ASSERT_EQ(result.diagnostics.all().size(), 1U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.zero-tool-radius");
  EXPECT_THAT(result.calls(), HasSubstr("STRAIGHT_FEED(10.0000, 0.0000"));
}

TEST(CutterCompensation, radius_and_orientation_come_from_the_tool_table_and_the_sign_changes_sides) {
  ProgramState state;
  state.modal.set(ModalGroup::plane, code(18));
  Tool tool;
  tool.number = 3;
  tool.diameter = Mm(2);
  tool.orientation = 7;
  ASSERT_TRUE(state.tools.add(tool));
  tool.diameter = Mm(-6);
  tool.orientation = 9;
  state.spindle_tool = tool;
  struct Case {
    const char* start;
    double x;
    double z;
  };
  for (const Case& expected : {Case{"G41 D3", 1, 9}, {"G42 D3", -1, 9}, {"G41", -3, 10}, {"G42 D0", 3, 10}}) {
    Diagnostics diagnostics;
    SymbolTable symbols;
    ProgramState copy = state;
    Parameters parameters(symbols, copy);
    Reporter reporter(diagnostics);
    OperationQueue operations;
    BlockContext context(copy, parameters, operations, reporter, no_answers());
    BlockExecutor executor(context, symbols);
    const BlockParser parser("test.ngc", symbols);
    const std::string file = "test.ngc";
    std::uint32_t line = 0;
    for (const char* const text : {expected.start, "G0 Z10", "M0"}) {
      Block block;
      ASSERT_TRUE(parser.parse(text, ++line, block, diagnostics));
      reporter.set_block(block, file);
      executor.execute(block);
    }
    EXPECT_TRUE(diagnostics.all().empty()) << render(diagnostics, false);
    operations.pop();  // the comment
    const auto* const move = std::get_if<operation::StraightTraverse>(&operations.front().what);
    ASSERT_NE(move, nullptr);
    EXPECT_NEAR(move->end[Axis::x], expected.x, 1e-12) << expected.start;
    EXPECT_NEAR(move->end[Axis::z], expected.z, 1e-12) << expected.start;
  }
}

TEST(CutterCompensation, parameters_tell_where_the_centre_is_and_the_contour_again_after_g40) {
  const Interpreted result = interpret_text(
      "G21 F100\nG42.1 D2\nG1 X10\n(debug,#5420 #5421 #<_y> #<_ccomp>)\nG40\n(debug,#5421 #<_ccomp>)\nM2\n");
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"10.000000 -1.000000 -1.000000 420.000000\")"));
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"0.000000 400.000000\")"));
}

TEST(CutterCompensation, one_gouge_is_one_error) {
  const Interpreted result = interpret_text("G21 F100\nG41.1 D4\nG1 X10\nX20\nY1\nX10\nX-20\nY-10\nX20\nG40\nX0\nM2\n");
  EXPECT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
}

TEST(CutterCompensation, an_arc_after_a_lathe_tools_entry_keeps_its_start) {
  // LinuxCNC's would lead the tool to the end of the entry arc first, and make a full circle of it.
  const Interpreted result = interpret_text("G21 F100\nG18\nG41.1 D2 L4\nG3 X10 Z10 I10\nG1 X20\nG40\nM2\n");
  EXPECT_THAT(result.calls(), HasSubstr("STRAIGHT_FEED(1.0000, 0.0000, 1.0000, 0.0000, 0.0000, 0.0000)\nARC_FEED("));
}

TEST(CutterCompensation, more_than_can_be_held_is_refused) {
  const Interpreted result =
      interpret_text("G21 F100\nG41.1 D2\nG1 X10\no1 repeat [1000]\nM8\no1 endrepeat\nX20\nG40\nM2\n");
  EXPECT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all().front().code, "gcode.too-much-held");
}

}  // namespace
}  // namespace passo
