#include "passo/tooling/cutting_feeds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

CuttingTool tool_of(CuttingShape shape, double diameter, std::uint32_t flutes = 2) {
  CuttingTool tool{.number = 1, .shape = shape, .diameter = Mm(diameter), .flutes = flutes};
  if (shape == CuttingShape::bull) tool.corner_radius = Mm(diameter / 10);
  if (shape == CuttingShape::vee || shape == CuttingShape::taper) tool.angle = {std::numbers::pi / 3};
  if (shape == CuttingShape::drill) tool.angle = {118 * std::numbers::pi / 180};
  if (shape == CuttingShape::taper) tool.tip = Mm(diameter / 6);
  return tool;
}

double per_minute(MmPerSecond speed) {
  return speed.value() * 60;
}

bool has_reason(const CuttingFeeds& feeds, std::string_view words) {
  return std::ranges::any_of(feeds.reasons,
                             [&](const FeedReason& reason) { return reason.text.find(words) != std::string::npos; });
}

TEST(CuttingFeeds, are_chip_load_times_flutes_times_speed) {
  // 1/8 inch in softwood: 0.003 inch per tooth, the lower end of the chart.
  const CuttingFeeds feeds = feeds_of(tool_of(CuttingShape::flat, 3.175), {.material = WorkMaterial::softwood});
  EXPECT_EQ(feeds.rpm, 18000);
  EXPECT_NEAR(per_minute(feeds.feed), 0.003 * 25.4 * 2 * 18000, 10);
  EXPECT_NEAR(per_minute(feeds.plunge), per_minute(feeds.feed) / 4, 1);
  EXPECT_EQ(feeds.depth_per_pass, Mm(3.175));
  EXPECT_EQ(feeds.step_over, 0.5);
  EXPECT_TRUE(has_reason(feeds, "2 flutes × 18000 rpm"));
}

TEST(CuttingFeeds, interpolate_between_the_diameters_of_a_chart_and_shrink_with_smaller_ones) {
  const auto least = [](double diameter) {
    return chip_range_of(tool_of(CuttingShape::flat, diameter), WorkMaterial::hardwood, Mm(0)).least.value();
  };
  EXPECT_NEAR(least(6.35), 0.005 * 25.4, 1e-12);
  EXPECT_NEAR(least((3.175 + 6.35) / 2), 0.0035 * 25.4, 1e-12);
  EXPECT_NEAR(least(3.175 / 4), 0.0005 * 25.4, 1e-12);
  EXPECT_NEAR(least(40), 0.017 * 25.4, 1e-12);
}

TEST(CuttingFeeds, of_deeper_passes_have_thinner_chips) {
  const CuttingTool tool = tool_of(CuttingShape::flat, 6);
  const auto least = [&](double depth) { return chip_range_of(tool, WorkMaterial::mdf, Mm(depth)).least.value(); };
  EXPECT_NEAR(least(12) / least(6), 0.75, 1e-12);
  EXPECT_NEAR(least(18) / least(6), 0.5, 1e-12);
  EXPECT_NEAR(least(60) / least(6), 0.5, 1e-12);
}

TEST(CuttingFeeds, in_metals_and_boards_follow_the_surface_speed) {
  const CuttingFeeds board =
      feeds_of(tool_of(CuttingShape::flat, 2), {.material = WorkMaterial::fr4, .spindle = {0, 60000}});
  EXPECT_NEAR(board.rpm, 100'000 / (std::numbers::pi * 2), 10);
  EXPECT_NEAR(per_minute(board.feed), 0.02 * board.rpm, 2);  // 1 % of the diameter in a revolution
  CuttingTool steel = tool_of(CuttingShape::flat, 6);
  steel.material = ToolMaterial::hss;
  const FeedRequest in_aluminium{.material = WorkMaterial::aluminium};
  EXPECT_NEAR(feeds_of(steel, in_aluminium).rpm * 2, feeds_of(tool_of(CuttingShape::flat, 6), in_aluminium).rpm, 20);
}

TEST(CuttingFeeds, are_clipped_by_spindle_tool_and_machine_with_the_reason) {
  CuttingTool tool = tool_of(CuttingShape::flat, 6);
  const CuttingFeeds spindle = feeds_of(tool, {.material = WorkMaterial::mdf, .spindle = {0, 10000}});
  EXPECT_EQ(spindle.rpm, 10000);
  EXPECT_TRUE(has_reason(spindle, "the limit of the spindle"));
  tool.most_rpm = 9000;
  const CuttingFeeds by_tool = feeds_of(tool, {.material = WorkMaterial::mdf, .spindle = {0, 10000}});
  EXPECT_EQ(by_tool.rpm, 9000);
  EXPECT_TRUE(has_reason(by_tool, "the limit of the tool"));

  // The machine is too slow: the spindle turns more slowly, and the chip keeps its thickness.
  tool.most_rpm.reset();
  const FeedRequest slow{.material = WorkMaterial::plywood, .most_feed = MmPerSecond(2000.0 / 60)};
  const CuttingFeeds kept = feeds_of(tool, slow);
  EXPECT_NEAR(per_minute(kept.feed), 2000, 1e-9);
  EXPECT_LT(kept.rpm, 8000);
  EXPECT_GE(kept.chip_load, kept.chip_range.least * 0.999);
  EXPECT_TRUE(has_reason(kept, "the limit of the machine"));
  // The spindle cannot turn that slowly: the chip becomes thinner.
  FeedRequest router = slow;
  router.spindle = {10000, 25000};
  EXPECT_EQ(feeds_of(tool, router).rpm, 10000);
  EXPECT_LT(feeds_of(tool, router).chip_load, kept.chip_range.least);
}

TEST(CuttingFeeds, of_a_large_cutter_keep_its_rim_slow_enough) {
  const CuttingTool cutter = tool_of(CuttingShape::flat, 100);
  const FeedRequest wood{.material = WorkMaterial::softwood};
  EXPECT_EQ(feeds_of(tool_of(CuttingShape::flat, 50), wood).rpm, 18000);
  EXPECT_EQ(feeds_of(cutter, wood).rpm, 9130) << "48 m/s";
  // 780 rpm in plastic: no limit is invented if the spindle is unknown, and a router spindle is too fast.
  FeedRequest plastic{.material = WorkMaterial::hdpe};
  EXPECT_EQ(feeds_of(tool_of(CuttingShape::flat, 500), {.material = WorkMaterial::fr4}).rpm, 60);
  EXPECT_EQ(feeds_of(cutter, plastic).rpm, 770);
  plastic.spindle = {8000, 24000};
  const CuttingFeeds fast = feeds_of(cutter, plastic);
  EXPECT_EQ(fast.rpm, 8000);
  EXPECT_TRUE(
      has_reason(fast, "too large for this spindle: 2513 m/min instead of 245 m/min; use one of at most 9.75 mm"));
}

TEST(CuttingFeeds, never_exceed_the_limit_of_the_tool) {
  CuttingTool tool = tool_of(CuttingShape::flat, 80);
  tool.most_rpm = 6000;
  const CuttingFeeds feeds = feeds_of(tool, {.material = WorkMaterial::mdf, .spindle = {8000, 24000}});
  EXPECT_EQ(feeds.rpm, 6000);
  EXPECT_TRUE(has_reason(feeds, "the spindle turns at 8000 rpm or more, too fast for this tool"));
}

TEST(CuttingFeeds, are_raised_in_narrow_cuts_until_the_chip_has_the_thickness_of_the_table) {
  const CuttingTool tool = tool_of(CuttingShape::flat, 6);
  const FeedRequest wide{.material = WorkMaterial::hdpe};
  FeedRequest narrow = wide;
  narrow.width = 0.1;
  // The example of the source: at a tenth of the diameter the chip is 0.6 of the feed per tooth.
  EXPECT_NEAR(feeds_of(tool, narrow).feed / feeds_of(tool, wide).feed, 1 / 0.6, 0.01);
  EXPECT_NEAR(feeds_of(tool, narrow).chip_load / feeds_of(tool, wide).chip_load, 1, 0.01);
}

TEST(CuttingFeeds, use_the_chip_load_of_the_tool) {
  CuttingTool tool = tool_of(CuttingShape::flat, 3);
  tool.chip_loads[WorkMaterial::brass] = Mm(0.01);
  const CuttingFeeds feeds = feeds_of(tool, {.material = WorkMaterial::brass, .spindle = {0, 10000}});
  EXPECT_NEAR(per_minute(feeds.feed), 200, 1);
  EXPECT_TRUE(has_reason(feeds, "from the tool library"));
}

TEST(CuttingFeeds, of_a_drill_are_a_plunge_and_a_tool_without_centre_teeth_has_none) {
  const CuttingFeeds drill =
      feeds_of(tool_of(CuttingShape::drill, 3.175), {.material = WorkMaterial::aluminium, .spindle = {0, 10000}});
  EXPECT_NEAR(per_minute(drill.feed), 0.0254 * 10000, 1);
  EXPECT_EQ(drill.plunge, drill.feed);
  EXPECT_EQ(drill.depth_per_pass, Mm(0));
  CuttingTool tool = tool_of(CuttingShape::flat, 6);
  tool.centre_cutting = false;
  EXPECT_EQ(feeds_of(tool, {.material = WorkMaterial::mdf}).plunge, MmPerSecond(0));
}

TEST(CuttingFeeds, are_within_every_limit_for_every_tool_and_material) {
  std::mt19937_64 random(test::seed());
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int trial = 0; trial < 5000; ++trial) {
    CuttingTool tool = tool_of(static_cast<CuttingShape>(random() % cutting_shapes), std::exp(draw(-4, 3.5)),
                               static_cast<std::uint32_t>(1 + random() % 6));
    if (random() % 2 == 0) tool.flute_length = Mm(draw(0.5, 40));
    if (random() % 4 == 0) tool.most_rpm = draw(5000, 30000);
    if (random() % 4 == 0) tool.material = ToolMaterial::hss;
    FeedRequest request{.material = static_cast<WorkMaterial>(random() % 10)};
    if (random() % 2 == 0) request.spindle = {draw(0, 9000), draw(9000, 60000)};
    if (random() % 2 == 0) request.most_feed = MmPerSecond(draw(1, 100));
    if (random() % 2 == 0) request.most_plunge = MmPerSecond(draw(1, 30));
    if (random() % 2 == 0) request.width = draw(0.01, 1);
    const CuttingFeeds feeds = feeds_of(tool, request);
    ASSERT_TRUE(std::isfinite(feeds.feed.value()) && feeds.feed > MmPerSecond(0)) << trial;
    ASSERT_GE(feeds.rpm, 10);
    if (request.spindle.most_rpm > 0 && (!tool.most_rpm || *tool.most_rpm > request.spindle.least_rpm)) {
      ASSERT_LE(feeds.rpm, request.spindle.most_rpm) << trial;
    }
    if (tool.most_rpm) ASSERT_LE(feeds.rpm, *tool.most_rpm) << trial;
    const bool is_drill = tool.shape == CuttingShape::drill;
    const MmPerSecond most = is_drill ? request.most_plunge : request.most_feed;
    if (most > MmPerSecond(0)) ASSERT_LE(feeds.feed.value(), most.value() * (1 + 1e-9)) << trial;
    if (request.most_plunge > MmPerSecond(0)) {
      ASSERT_LE(feeds.plunge.value(), request.most_plunge.value() * (1 + 1e-9)) << trial;
    }
    if (tool.flute_length > Mm(0)) ASSERT_LE(feeds.depth_per_pass, tool.flute_length) << trial;
    ASSERT_LE(feeds.chip_load.value(), feeds.chip_range.most.value() * 1.01) << trial;
    ASSERT_GE(feeds.reasons.size(), 4U);
  }
}

TEST(WorkMaterial, is_recognized_by_common_words) {
  const auto is = [](std::string_view words, WorkMaterial material) {
    const auto found = work_material_of(words);
    return found && *found == material;
  };
  EXPECT_TRUE(is("pine", WorkMaterial::softwood));
  EXPECT_TRUE(is("Oak, white", WorkMaterial::hardwood));
  EXPECT_TRUE(is("birch plywood", WorkMaterial::plywood));
  EXPECT_TRUE(is("aluminium 6082", WorkMaterial::aluminium));
  EXPECT_TRUE(is("EN AW-6061", WorkMaterial::aluminium));
  EXPECT_TRUE(is("Delrin", WorkMaterial::hdpe));
  for (const char* const words : {"", "oaks", "steel", "pineapple", "foamy", "\xff\xfe"}) {
    EXPECT_FALSE(work_material_of(words)) << words;
  }
  for (const std::string_view name : work_material_names()) {
    EXPECT_EQ(name_of(*work_material_of(name)), name);
  }
}

}  // namespace
}  // namespace passo
