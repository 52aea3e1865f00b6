#include "passo/cutting/stock_job.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

StockJob job_of(const std::string& text) {
  return {.program = ProgramReader::from_text("part.ngc", text), .options = {}};
}

StockWishes with_flat(double diameter) {
  StockWishes wishes;
  wishes.any_tool = ToolShape{.cutter = Cutter::flat_end(Mm(diameter))};
  return wishes;
}

const std::string slot = "G21 G90 G54\nG0 Z5\nG0 X10 Y0\nG1 Z-2 F300\nG1 X30\nG0 Z5\nM2\n";

FeedLook look_at(const StockJob& job, const StockWishes& wishes) {
  Diagnostics findings;
  FeedLook look = survey_feeds(job, wishes, findings);
  EXPECT_FALSE(findings.any_error());
  return look;
}

TEST(StockJobs, look_at_what_the_feeds_reach) {
  unsigned moves = 0;
  Diagnostics findings;
  const FeedLook look = survey_feeds(job_of(slot), with_flat(6), findings, [&moves] { ++moves; });
  EXPECT_EQ(look.moves, moves);
  EXPECT_EQ(moves, 5U);
  EXPECT_EQ(look.feeds.low, (Vector3{7, -3, -2})) << "the edges of the tool in X and Y, its tip in Z";
  EXPECT_EQ(look.feeds.high, (Vector3{33, 3, 5}));
  EXPECT_EQ(look.tools, (std::map<std::int32_t, std::uint32_t>{{0, 4}}));
  EXPECT_EQ(look.numbers(), std::vector<std::int32_t>{0});
  EXPECT_EQ(look.zero, 0);
}

// As `passo cam job` writes it for Grbl, where M6 is an error.
TEST(StockJobs, a_tool_that_is_changed_by_hand_cuts_from_then_on) {
  const std::string program =
      "G21 G90 G54\n(tool 2: flat end, 5 mm)\nT2\nM0\nG0 Z5\nG1 Z-2 F300\nG0 Z5\nT1\nM0\nG1 X30 Z-1\nM2\n";
  const FeedLook look = look_at(job_of(program), with_flat(6));
  EXPECT_EQ(look.tools, (std::map<std::int32_t, std::uint32_t>{{1, 10}, {2, 6}}));
}

TEST(StockJobs, a_program_with_one_tool_names_it_in_a_comment) {
  const FeedLook look = look_at(job_of("(tool: T6 flat end, 3 mm)\n" + slot), with_flat(3));
  EXPECT_EQ(look.numbers(), std::vector<std::int32_t>{6});
}

// The place of the work does not matter: it lies at its zero.
TEST(StockJobs, look_at_the_work_and_not_at_the_machine) {
  StockJob job = job_of(slot);
  job.options.parameters[5221] = -100;
  job.options.parameters[5223] = -40;
  const FeedLook look = look_at(job, with_flat(6));
  EXPECT_EQ(look.feeds.low, (Vector3{7, -3, -2}));
  EXPECT_EQ(look.zero, -40);
}

TEST(StockJobs, make_the_block_as_large_as_the_feeds_need) {
  const StockJob job = job_of(slot);
  StockWishes wishes = with_flat(6);
  const auto field = stock_field(wishes, look_at(job, wishes));
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_EQ(field->block().low, (Vector3{7, -3, -4})) << "2 mm below the deepest feed";
  EXPECT_EQ(field->block().high, (Vector3{33, 3, 0}));
  wishes.block.x = {.low = 0, .high = 50};
  wishes.cell = 0.5;
  const auto wider = stock_field(wishes, look_at(job, wishes));
  ASSERT_TRUE(wider);
  EXPECT_EQ(wider->block().low, (Vector3{0, -3, -4}));
  EXPECT_EQ(wider->cell(), 0.5);
}

TEST(StockJobs, have_no_stock_without_a_feed) {
  const StockJob job = job_of("G21 G90\nG0 X10\nM2\n");
  StockWishes wishes = with_flat(6);
  const auto none = stock_field(wishes, look_at(job, wishes));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "") << "nobody says how large it is";
  wishes.block = {.x = {0, 10}, .y = {0, 10}, .z = {-5, 0}};
  EXPECT_TRUE(stock_field(wishes, look_at(job, wishes)));
  wishes.cell = 1e-9;
  const auto too_fine = stock_field(wishes, look_at(job, wishes));
  ASSERT_FALSE(too_fine);
  EXPECT_NE(too_fine.error().message, "");
}

// A wish for one tool, then a wish for all, then the diameter in the machine's tool table.
TEST(StockJobs, know_the_shapes_of_tools_from_three_places) {
  StockJob job = job_of("G21 G90\nT2 M6\nG1 X1 F100\nT1 M6\nG1 X2\nT2 M6\nG1 X3\nM2\n");
  ASSERT_TRUE(job.options.tools.add({.number = 1, .pocket = 1, .diameter = Mm(4)}));
  ASSERT_TRUE(job.options.tools.add({.number = 2, .pocket = 2}));
  StockWishes wishes;
  const auto missing = shapes_of(job, wishes, look_at(job, wishes));
  ASSERT_FALSE(missing);
  ASSERT_EQ(missing.error().size(), 1U);
  EXPECT_EQ(missing.error()[0].number, 2);
  EXPECT_EQ(missing.error()[0].line, 3U) << "its first feed";
  wishes.shapes[2] = ToolShape{.cutter = Cutter::flat_end(Mm(8))};
  const FeedLook look = look_at(job, wishes);
  const auto shapes = shapes_of(job, wishes, look);
  ASSERT_TRUE(shapes);
  EXPECT_EQ(look.numbers(), (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ((*shapes)[look.places().at(1)].cutter.radius, Mm(2));
  EXPECT_EQ((*shapes)[look.places().at(2)].cutter.radius, Mm(4));
  wishes.any_tool = ToolShape{.cutter = Cutter::flat_end(Mm(1))};
  EXPECT_EQ((*shapes_of(job, wishes, look))[0].cutter.radius, Mm(0.5)) << "goes before the table";
}

TEST(StockJobs, cut_what_the_tool_sweeps) {
  const StockJob job = job_of(slot);
  StockWishes wishes = with_flat(6);
  wishes.block = {.x = {0, 40}, .y = {-10, 10}, .z = {-10, 0}};
  wishes.cell = 0.1;
  const FeedLook look = look_at(job, wishes);
  auto field = stock_field(wishes, look);
  ASSERT_TRUE(field);
  const double before = field->volume();
  const auto tools = shapes_of(job, wishes, look);
  unsigned cuts = 0;
  unsigned told = 0;
  CutHooks hooks;
  hooks.cut = [&cuts](const MoveCut&) { ++cuts; };
  hooks.progress = [&told](double) { ++told; };
  cut_stock(job, wishes, look, *tools, 1, *field, hooks);
  constexpr double pi = 3.14159265358979;
  EXPECT_NEAR(before - field->volume(), 2 * (20 * 6 + pi * 9), 3) << "2 mm deep, 20 mm long, with round ends";
  EXPECT_EQ(cuts, 5U);
  EXPECT_EQ(told, 1U);
}

}  // namespace
}  // namespace passo
