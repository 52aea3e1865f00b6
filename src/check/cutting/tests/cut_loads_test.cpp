#include "passo/cutting/cut_loads.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr double material = 800;    // N/mm²
constexpr double speed = 12'000;    // rpm
constexpr double radius = 3;        // mm
constexpr double deep = 2;          // mm
constexpr double feed = 600 / 60.;  // mm/s

// force = k · area · v / (2π · r · n), for a slot as wide as the tool.
constexpr double slot_force = material * (2 * radius * deep) * feed / (2 * std::numbers::pi * radius * speed / 60);

CutOutcome cut(const std::string& text, const CutMaterial& wood) {
  const StockJob job{.program = ProgramReader::from_text("part.ngc", text), .options = {}};
  StockWishes wishes;
  wishes.any_tool = ToolShape{.cutter = Cutter::flat_end(Mm(2 * radius))};
  wishes.block = {.x = {0, 60}, .y = {-10, 10}, .z = {-10, 0}};
  wishes.cell = 0.1;
  Diagnostics findings;
  const FeedLook look = survey_feeds(job, wishes, findings);
  return cut_with_force(job, wishes, look, *shapes_of(job, wishes, look), *stock_field(wishes, look), wood);
}

std::string cut_slot(const std::string& spindle) {
  return "G21 G90\n" + spindle + "\nG0 Z5\nG0 X-5 Y0\nG1 Z-2 F600\nG1 X50\nG0 Z5\nM2\n";
}

PlannedMove move_of(std::uint32_t line, double from, double to) {
  Segment segment;
  Point begin;
  Point end;
  begin[Axis::x] = from;
  end[Axis::x] = to;
  segment.curve = Curve::line(begin, end);
  segment.source.line = line;
  PlannedMove move;
  move.begin_on(segment);
  move.phase_count = 1;
  move.to = segment.curve.length();
  return move;
}

TEST(CutWithForce, is_the_formula_for_a_slot) {
  CutOutcome outcome = cut(cut_slot("S12000 M3"), {.specific_force = material});
  EXPECT_EQ(outcome.silent_line, 0U);
  EXPECT_EQ(outcome.force.line, 6U);
  EXPECT_NEAR(outcome.force.value, slot_force, 0.05 * slot_force);
  EXPECT_EQ(outcome.loads.feeds(), 2U) << "the plunge beside the stock, and the slot";
  EXPECT_LT(outcome.loads.of(move_of(5, 0, 7)) * feed, slot_force / 10) << "only its last piece comes near the stock";
  EXPECT_NEAR(outcome.loads.of(move_of(6, -5, 50)) * feed, outcome.force.value, 1e-3);
  EXPECT_EQ(outcome.loads.unknown(), 0U);
  EXPECT_NEAR(outcome.simulation.volume_before - outcome.simulation.field.volume(), outcome.simulation.summary.volume(),
              1e-6);
}

TEST(CutWithForce, is_unknown_without_a_spindle_speed) {
  const CutOutcome silent = cut(cut_slot("M3"), {.specific_force = material});
  EXPECT_EQ(silent.silent_line, 6U);
  EXPECT_EQ(silent.force.value, 0);
  const CutOutcome said = cut(cut_slot("M3"), {.specific_force = material, .revolutions_per_minute = speed});
  EXPECT_EQ(said.silent_line, 0U);
  EXPECT_NEAR(said.force.value, slot_force, 0.05 * slot_force);
}

TEST(CutWithForce, finds_what_goes_wrong_in_the_stock) {
  const CutOutcome outcome =
      cut("G21 G90 S12000 M3\nG0 Z5\nG0 X30\nG0 Z-2\nG1 X40 F300\nM2\n", {.specific_force = material});
  Diagnostics findings;
  add_findings(outcome.simulation, findings);
  ASSERT_EQ(findings.errors(), 1U);
  EXPECT_EQ(findings.all()[0].code, "simulate.rapid");
  EXPECT_EQ(findings.all()[0].place.line, 4U);
}

// A feed that is missing on one side does not shift those that follow.
TEST(CutLoads, find_their_feeds_by_line_and_length) {
  CutLoads loads;
  const auto add = [&loads](std::uint32_t line, double length, double force) {
    loads.raise(loads.add(move_of(line, 0, length).segment), force);
  };
  add(1, 10, 1);
  add(2, 10, 2);
  add(3, 10, 3);
  EXPECT_EQ(loads.feeds(), 3U);
  EXPECT_EQ(loads.of(move_of(1, 0, 10)), 1);
  EXPECT_EQ(loads.of(move_of(7, 0, 10)), 0) << "it was not cut";
  EXPECT_EQ(loads.of(move_of(3, 0, 10)), 3) << "the feed of line 2 was not planned";
  EXPECT_EQ(loads.of(move_of(3, 0, 10.1)), 0);
  EXPECT_EQ(loads.unknown(), 2U);
  PlannedMove rapid = move_of(3, 0, 10);
  rapid.segment.rapid = true;
  EXPECT_EQ(loads.of(rapid), 0);
  EXPECT_EQ(loads.unknown(), 2U) << "a rapid has no force";
}

TEST(CutLoads, are_those_of_the_hardest_piece_of_a_feed) {
  CutLoads loads;
  const std::size_t index = loads.add(move_of(1, 0, 10).segment);
  for (const double force : {1.0, 4.0, 2.0}) loads.raise(index, force);
  EXPECT_EQ(loads.of(move_of(1, 0, 10)), 4);
}

}  // namespace
}  // namespace passo
