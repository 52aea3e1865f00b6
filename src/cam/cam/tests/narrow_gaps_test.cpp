#include <algorithm>
#include <cmath>
#include <random>

#include "isolated_pads.hpp"
#include "milled_picture.hpp"
#include <gtest/gtest.h>

#include "passo/cam/board_layer.hpp"
#include "passo/cam/isolation.hpp"
#include "passo/cam/isolation_advice.hpp"
#include "passo/cam/isolation_proof.hpp"
#include "passo/cam/joined_nets.hpp"
#include "passo/cam/mill_program.hpp"

namespace passo {
namespace {

using test::isolated;
using test::pad;
using test::spot;
using test::two_pads;
using test::wide;
using test::with;

// The program beside the copper, in pixels.
test::MilledPicture picture_of(const Region& copper, const MillPlan& plan, double pixel) {
  const DrawnBox box = *bounds(copper);
  const auto mm = [](Nanometres length) { return to_mm(length).value(); };
  test::MilledPicture picture(mm(box.least.x) - 1, mm(box.least.y) - 1, mm(box.most.x) + 1, mm(box.most.y) + 1, pixel);
  std::vector<test::MilledPicture::Corners> rings;
  for (const DrawnRing& ring : copper.rings) {
    rings.emplace_back();
    for (const DrawnPoint& point : ring) rings.back().emplace_back(mm(point.x), mm(point.y));
  }
  picture.draw_copper(rings);
  for (const MillTool& tool : plan.tools)
    picture.mill(write_mill_program({{tool}, {}}, {.name = "i.ngc", .command = "test"}), mm(tool.width));
  return picture;
}

// The number of islands that are still joined to another one in the picture. `kept`: what is left of each.
std::size_t joined_in(test::MilledPicture& picture, const std::vector<Region>& kept) {
  test::MilledPicture::Corners places;
  for (const Region& island : kept) {
    // A place well within: the first corner of what is left when the rim is taken away.
    Region inside = grown(island, {-10'000});
    if (inside.empty()) inside = island;
    const DrawnPoint at = inside.rings.front().front();
    places.emplace_back(to_mm(at.x).value(), to_mm(at.y).value());
  }
  const std::vector<int> pieces = picture.pieces_at(places);
  std::size_t joined = 0;
  for (const int piece : pieces) joined += std::ranges::count(pieces, piece) > 1 ? 1 : 0;
  return joined;
}

TEST(NarrowGaps, a_narrow_gap_is_milled_midway_and_both_sides_give) {
  IsolationOptions options = with({0.2});
  options.allowed_loss = wide(0.03);
  const Region copper = two_pads(0.15);
  const auto [plan, proof] = isolated(copper, options);
  EXPECT_TRUE(plan.gaps.empty());
  EXPECT_EQ(proof.joined, 0U);
  EXPECT_EQ(proof.damage_mm2, 0);
  // Along 2 mm the cutter is 0.05 mm wider than the gap; the proof's disc a little more.
  EXPECT_NEAR(proof.lost_mm2, 2 * 0.05, 0.015);
  EXPECT_NEAR(to_mm(proof.deepest).value(), 0.025, 0.004);
  test::MilledPicture picture = picture_of(copper, plan.mill, 0.005);
  EXPECT_EQ(joined_in(picture, plan.kept), 0U);
  EXPECT_NEAR(picture.lost_mm2(), 2 * 0.05, 0.02);
  EXPECT_LE(picture.deepest_loss(0.1), 0.03 + 0.005);

  options.allowed_loss = wide(0.02);
  const auto [less, joined] = isolated(copper, options);
  EXPECT_EQ(joined.joined, 2U);
  EXPECT_LT(joined.lost_mm2, 0.005);  // at the mouths of the gap
  EXPECT_EQ(less.gaps.size(), 1U);
}

TEST(NarrowGaps, random_layouts_with_gaps_near_the_cutter_keep_what_must_stay) {
  std::mt19937 random(1);
  const auto between = [&random](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  for (int layout = 0; layout < 60; ++layout) {
    SCOPED_TRACE(layout);
    IsolationOptions options = with({between(0.1, 0.3)});
    options.allowed_loss = wide(between(0.005, 0.06));
    options.least_trace = wide(between(0.02, 0.2));
    options.passes = 1 + static_cast<std::uint32_t>(layout) % 3;
    const double pitch = between(0.3, 1);
    const double size = std::max(0.06, pitch - to_mm(options.cutters[0].width).value() * between(0.4, 1.15));
    std::vector<Region> shapes;
    for (int i = 0; i < 9; ++i) {
      const DrawnPoint at = spot(pitch * (i % 3), pitch * (i / 3));
      const DrawnPoint end = spot(pitch * (i % 3) + size / 4, pitch * (i / 3) + between(-0.2, 0.2));
      shapes.push_back(random() % 2 == 0 ? pad(pitch * (i % 3), pitch * (i / 3), size)
                                         : swept({{at, end}}, wide(size / 4)));
    }
    const auto [plan, proof] = isolated(united(shapes), options);
    EXPECT_EQ(proof.damage_mm2, 0);
    EXPECT_TRUE(proof.broken.empty());
  }
}

// A trace of 0.12 mm between two pads may lose 0.01 mm on each side, so the pads give the rest.
TEST(NarrowGaps, a_trace_keeps_its_least_width_and_the_pads_give) {
  IsolationOptions options = with({0.2});
  options.allowed_loss = wide(0.03);
  const Region trace = filled({rectangle({spot(1.17, -2), spot(1.29, 2)})});
  const Region copper = united({pad(0, 0, 2), trace, pad(2.46, 0, 2)});
  const auto [plan, proof] = isolated(copper, options);
  EXPECT_EQ(proof.joined, 0U);
  EXPECT_EQ(proof.damage_mm2, 0);
  EXPECT_TRUE(proof.broken.empty());
  test::MilledPicture picture = picture_of(copper, plan.mill, 0.005);
  EXPECT_EQ(joined_in(picture, plan.kept), 0U);
  for (double y = -1; y <= 1; y += 0.1) {
    int across = 0;
    for (double x = 1.1525; x < 1.3; x += 0.005) across += picture.is_copper_left(x, y) ? 1 : 0;
    EXPECT_GE(across, 20) << y;
  }
  // A trace that is not wider than the least width gives nothing.
  options.least_trace = wide(0.125);
  EXPECT_EQ(isolated(copper, options).proof.joined, 3U);
}

TEST(NarrowGaps, random_layouts_give_only_what_is_allowed_and_are_apart_as_proved) {
  std::mt19937_64 random(11);
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  std::size_t parted = 0;
  for (int layout = 0; layout < 8; ++layout) {
    std::vector<Region> shapes;
    for (int i = 0; i < 14; ++i) {
      const DrawnPoint from = spot(between(0, 6), between(0, 6));
      shapes.push_back(i % 2 == 0 ? pad(between(0, 6), between(0, 6), between(0.3, 1.5))
                                  : swept({{from, spot(between(0, 6), between(0, 6))}}, wide(between(0.05, 0.3))));
    }
    const Region copper = united(shapes);
    IsolationOptions options = with({layout % 2 == 0 ? 0.3 : 0.2});
    const std::size_t before = isolated(copper, options).proof.joined;
    options.allowed_loss = wide(0.05);
    const auto [plan, proof] = isolated(copper, options);
    EXPECT_EQ(proof.damage_mm2, 0) << layout;
    EXPECT_TRUE(proof.broken.empty()) << layout;
    EXPECT_LE(proof.joined, before) << layout;
    parted += before - proof.joined;
    test::MilledPicture picture = picture_of(copper, plan.mill, 0.01);
    EXPECT_LE(picture.deepest_loss(0.2), 0.05 + 0.01) << layout;
    EXPECT_EQ(joined_in(picture, plan.kept.empty() ? parts_of(copper) : plan.kept), proof.joined) << layout;
  }
  EXPECT_GT(parted, 0U);
}

TEST(JoinedNets, are_islands_with_pads_holes_or_names) {
  // Four pads in a row, 0.15 mm apart, and a far one.
  const Region copper = united({pad(0, 0, 2), pad(2.15, 0, 2), pad(4.3, 0, 2), pad(6.45, 0, 2), pad(20, 0, 2)});
  const auto [plan, proof] = isolated(copper, with({0.2}));
  EXPECT_EQ(proof.joined, 4U);
  JoinedNets all = find_joined_nets(copper, {}, plan.mill, proof, wide(0.2));
  EXPECT_EQ(all.nets, 5U);
  EXPECT_EQ(all.joined, 4U);
  EXPECT_EQ(all.groups, 1U);
  ASSERT_EQ(all.gaps.size(), 3U);
  EXPECT_EQ(all.gaps[0].width, wide(0.15));
  // The second is text: it joins the first one with the others all the same.
  std::vector<NetPlace> known = {{spot(0, 0), "A", {}}, {spot(4.3, 0), "B", {}}, {spot(20, 0), "A", {}}};
  JoinedNets named = find_joined_nets(copper, known, plan.mill, proof, wide(0.2));
  EXPECT_EQ(named.nets, 2U);
  EXPECT_EQ(named.joined, 2U);
  EXPECT_EQ(named.others, 2U);
  known[1].net = "A";
  EXPECT_EQ(find_joined_nets(copper, known, plan.mill, proof, wide(0.2)).joined, 0U) << "one net, drawn in two islands";
}

// The cutter reaches into both mouths of a gap between parallel traces, where all of their corners are.
TEST(JoinedNets, every_one_of_them_is_beside_a_gap_that_is_not_milled) {
  const auto bar = [](double from, double to, double low, double high) {
    return Region{{{spot(from, low), spot(to, low), spot(to, high), spot(from, high)}}};
  };
  const Region copper =
      united({bar(0, 10, 0, 1), bar(2, 8, 1.19, 2), bar(3, 7, 2.2, 3), pad(20, 0, 2), pad(22.1, 0, 2)});
  const auto [plan, proof] = isolated(copper, with({0.2}));
  ASSERT_EQ(proof.joined, 5U);
  const JoinedNets found = find_joined_nets(copper, {}, plan.mill, proof, wide(0.2));
  ASSERT_EQ(found.gaps.size(), 3U);
  const test::MilledPicture picture = picture_of(copper, plan.mill, 0.002);
  std::vector<Nanometres> widths;
  for (const CopperGap& gap : found.gaps) {
    widths.push_back(gap.width);
    EXPECT_FALSE(picture.is_milled(to_mm(gap.at.x).value(), to_mm(gap.at.y).value())) << gap.at.x.count;
  }
  EXPECT_EQ(widths, (std::vector{wide(0.1), wide(0.19), wide(0.2)}));
}

TEST(IsolationAdvice, is_tried) {
  const Region copper = united(two_pads(0.08), pad(10, 0, 2));
  IsolationOptions options = with({0.3});
  options.allowed_loss = wide(0.03);
  const auto [plan, proof] = isolated(copper, options);
  const JoinedNets joined = find_joined_nets(copper, {}, plan.mill, proof, wide(0.3));
  EXPECT_EQ(joined.joined, 2U);
  const std::vector<IsolationCutter> finer = {{wide(0.3), ""}, {wide(0.2), ""}, {wide(0.12), ""}, {wide(0.1), ""}};
  const auto advice = advise_isolation(copper, {}, options, joined, finer, wide(0.05));
  ASSERT_TRUE(advice);
  EXPECT_EQ(advice->cutter, 2U);  // 0.08 + 2 x 0.03 mm
  EXPECT_EQ(advice->joined, 0U);
  EXPECT_EQ(advice->allowed_loss, wide(0.03));
  options.cutters[0].width = finer[advice->cutter].width;
  EXPECT_EQ(isolated(copper, options).proof.joined, 0U);
}

TEST(IsolationAdvice, thins_traces_only_where_nothing_else_parts_all_nets) {
  // To part them, each must lose 0.0355 mm of its 0.15 mm.
  const auto trace = [](double y) { return swept({{spot(0, y), spot(4, y)}}, wide(0.075)); };
  const Region copper = united(trace(0), trace(0.185));
  IsolationOptions options = with({0.1});
  options.allowed_loss = wide(0.03);
  const auto [plan, proof] = isolated(copper, options);
  const JoinedNets joined = find_joined_nets(copper, {}, plan.mill, proof, wide(0.1));
  ASSERT_EQ(joined.joined, 2U);
  const auto advice = advise_isolation(copper, {}, options, joined, {{wide(0.1), ""}}, wide(0.05));
  ASSERT_TRUE(advice);
  EXPECT_EQ(advice->joined, 0U);
  EXPECT_EQ(advice->least_trace, wide(0.075));
  options.allowed_loss = advice->allowed_loss;
  EXPECT_EQ(isolated(copper, options).proof.joined, 2U) << "with the width that traces keep by default";
  options.least_trace = advice->least_trace;
  EXPECT_EQ(isolated(copper, options).proof.joined, 0U);
}

// The board of the examples, with the cutter and the loss that the report advises: its narrowest gap is 0.018 mm.
TEST(NarrowGaps, every_net_of_the_example_board_comes_apart) {
  Diagnostics findings;
  const std::string folder = std::string(PASSO_SOURCE_DIR) + "/examples/boards/";
  const BoardLayer layer = read_board_layer(folder + "timer-B_Cu.gbr", {}, findings);
  ASSERT_FALSE(findings.any_error());
  IsolationOptions options = with({0.1});
  options.allowed_loss = wide(0.045);
  const auto [plan, proof] = isolated(layer.face, options);
  EXPECT_EQ(proof.damage_mm2, 0);
  EXPECT_EQ(proof.joined, 0U);
  EXPECT_EQ(find_joined_nets(layer.face, layer.nets, plan.mill, proof, wide(0.1)).joined, 0U);
  test::MilledPicture picture = picture_of(layer.face, plan.mill, 0.02);
  EXPECT_EQ(joined_in(picture, plan.kept), 0U);
  EXPECT_LE(picture.deepest_loss(0.2), 0.045 + 0.02);
}

}  // namespace
}  // namespace passo
